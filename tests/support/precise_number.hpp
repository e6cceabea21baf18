// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of 256 bits, rounded to nearest: an oracle that is right to far more digits than a double
// has, without a bound. For tests only.
#pragma once

#include <mpfr.h>

#include <string>
#include <utility>
#include <vector>

namespace regulus::detail::test {

class Precise {
 public:
  Precise(double x = 0) { mpfr_init2(value_, kBits), mpfr_set_d(value_, x, MPFR_RNDN); }
  explicit Precise(const std::string& decimal) {
    mpfr_init2(value_, kBits), mpfr_set_str(value_, decimal.c_str(), 10, MPFR_RNDN);
  }
  Precise(const Precise& other) {
    mpfr_init2(value_, kBits), mpfr_set(value_, other.value_, MPFR_RNDN);
  }
  Precise& operator=(const Precise& other) {
    mpfr_set(value_, other.value_, MPFR_RNDN);
    return *this;
  }
  ~Precise() { mpfr_clear(value_); }

  [[nodiscard]] double to_double() const { return mpfr_get_d(value_, MPFR_RNDN); }

  friend Precise operator+(const Precise& a, const Precise& b) { return of(mpfr_add, a, b); }
  friend Precise operator-(const Precise& a, const Precise& b) { return of(mpfr_sub, a, b); }
  friend Precise operator*(const Precise& a, const Precise& b) { return of(mpfr_mul, a, b); }
  friend Precise operator/(const Precise& a, const Precise& b) { return of(mpfr_div, a, b); }
  friend Precise sin(const Precise& a) { return of(mpfr_sin, a); }
  friend Precise cos(const Precise& a) { return of(mpfr_cos, a); }
  friend Precise abs(const Precise& a) { return of(mpfr_abs, a); }
  friend bool operator<(const Precise& a, const Precise& b) {
    return mpfr_less_p(a.value_, b.value_) != 0;
  }
  [[nodiscard]] static Precise pi() {
    Precise result;
    mpfr_const_pi(result.value_, MPFR_RNDN);
    return result;
  }

 private:
  static constexpr mpfr_prec_t kBits = 256;

  template <class Operation>
  static Precise of(Operation operation, const Precise& a) {
    Precise result;
    operation(result.value_, a.value_, MPFR_RNDN);
    return result;
  }
  template <class Operation>
  static Precise of(Operation operation, const Precise& a, const Precise& b) {
    Precise result;
    operation(result.value_, a.value_, b.value_, MPFR_RNDN);
    return result;
  }

  mpfr_t value_;
};

/// Solves A·x = b by elimination with pivots; A is row-major.
inline std::vector<Precise> solved(std::vector<std::vector<Precise>> A, std::vector<Precise> b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < n; ++i)
      if (abs(A[pivot][k]) < abs(A[i][k])) pivot = i;
    std::swap(A[k], A[pivot]), std::swap(b[k], b[pivot]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const Precise factor = A[i][k] / A[k][k];
      for (std::size_t j = k; j < n; ++j) A[i][j] = A[i][j] - factor * A[k][j];
      b[i] = b[i] - factor * b[k];
    }
  }
  for (std::size_t k = 0; k < n; ++k) b[k] = b[k] / A[k][k];
  return b;
}

/// Newton's method for f(x) = 0, with difference quotients of step 1e-30.
template <class System>
std::vector<Precise> root_near(const System& f, std::vector<Precise> x) {
  const Precise step("1e-30");
  for (int iteration = 0; iteration < 60; ++iteration) {
    const std::vector<Precise> value = f(x);
    std::vector<std::vector<Precise>> J(value.size(), std::vector<Precise>(x.size()));
    for (std::size_t j = 0; j < x.size(); ++j) {
      std::vector<Precise> moved = x;
      moved[j] = moved[j] + step;
      const std::vector<Precise> there = f(moved);
      for (std::size_t i = 0; i < value.size(); ++i) J[i][j] = (there[i] - value[i]) / step;
    }
    const std::vector<Precise> correction = solved(std::move(J), value);
    for (std::size_t j = 0; j < x.size(); ++j) x[j] = x[j] - correction[j];
  }
  return x;
}

}  // namespace regulus::detail::test
