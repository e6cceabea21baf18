// SPDX-License-Identifier: GPL-3.0-or-later
// Exact arithmetic on doubles, for tests about determinants.
#pragma once

#include <flint/fmpq.h>
#include <flint/fmpq_mat.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/interval/interval.hpp"

namespace regulus::detail::test {

/// A rational number.
class Exact {
 public:
  Exact() { fmpq_init(value_); }
  /// Requires  x finite.
  Exact(double x) : Exact() {
    int exponent = 0;
    const double fraction = std::frexp(x, &exponent);
    fmpz_set_si(fmpq_numref(value_), static_cast<std::int64_t>(std::ldexp(fraction, 53)));
    if (exponent >= 53)
      fmpz_mul_2exp(fmpq_numref(value_), fmpq_numref(value_), static_cast<ulong>(exponent - 53));
    else
      fmpz_mul_2exp(fmpq_denref(value_), fmpq_denref(value_), static_cast<ulong>(53 - exponent));
    fmpq_canonicalise(value_);
  }
  Exact(const Exact& other) : Exact() { fmpq_set(value_, other.value_); }
  Exact& operator=(const Exact& other) {
    fmpq_set(value_, other.value_);
    return *this;
  }
  ~Exact() { fmpq_clear(value_); }

  friend Exact operator+(const Exact& a, const Exact& b) { return apply(fmpq_add, a, b); }
  friend Exact operator-(const Exact& a, const Exact& b) { return apply(fmpq_sub, a, b); }
  friend Exact operator*(const Exact& a, const Exact& b) { return apply(fmpq_mul, a, b); }
  friend bool operator<(const Exact& a, const Exact& b) { return fmpq_cmp(a.value_, b.value_) < 0; }
  friend bool operator<=(const Exact& a, const Exact& b) { return !(b < a); }
  [[nodiscard]] int sign() const { return fmpq_sgn(value_); }
  [[nodiscard]] Exact abs() const {
    Exact result;
    fmpq_abs(result.value_, value_);
    return result;
  }

  fmpq* get() { return value_; }
  [[nodiscard]] const fmpq* get() const { return value_; }

 private:
  template <typename Operation>
  static Exact apply(Operation operation, const Exact& a, const Exact& b) {
    Exact result;
    operation(result.value_, a.value_, b.value_);
    return result;
  }
  fmpq_t value_;
};

/// Returns true if x ∈ enclosure; an infinite bound is no restriction.
inline bool holds(const Interval& enclosure, const Exact& x) {
  return (std::isinf(enclosure.lo) || Exact(enclosure.lo) <= x) &&
         (std::isinf(enclosure.hi) || x <= Exact(enclosure.hi));
}

/// Returns the determinant of an n×n matrix, row-major.
inline Exact determinant(std::span<const Exact> entries, std::size_t n) {
  fmpq_mat_t M;
  const slong order = static_cast<slong>(n);
  fmpq_mat_init(M, order, order);
  for (slong i = 0; i < order; ++i)
    for (slong j = 0; j < order; ++j)
      fmpq_set(fmpq_mat_entry(M, i, j), entries[static_cast<std::size_t>(i * order + j)].get());
  Exact result;
  fmpq_mat_det(result.get(), M);
  fmpq_mat_clear(M);
  return result;
}

}  // namespace regulus::detail::test
