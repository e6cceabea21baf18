// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arf.h>
#include <fmpq.h>

#include <string>

namespace regulus::verifier {

/// An owned fmpq_t.
class Rational {
 public:
  Rational() noexcept { fmpq_init(value_); }
  explicit Rational(long value) noexcept : Rational() { fmpq_set_si(value_, value, 1); }
  Rational(const Rational& other) noexcept : Rational() { fmpq_set(value_, other.value_); }
  Rational(Rational&& other) noexcept : Rational() { fmpq_swap(value_, other.value_); }
  Rational& operator=(const Rational& other) noexcept {
    fmpq_set(value_, other.value_);
    return *this;
  }
  Rational& operator=(Rational&& other) noexcept {
    fmpq_swap(value_, other.value_);
    return *this;
  }
  ~Rational() { fmpq_clear(value_); }

  [[nodiscard]] fmpq* get() noexcept { return value_; }
  [[nodiscard]] const fmpq* get() const noexcept { return value_; }

  [[nodiscard]] bool is_zero() const noexcept { return fmpq_is_zero(value_) != 0; }
  [[nodiscard]] int sign() const noexcept { return fmpq_sgn(value_); }
  [[nodiscard]] bool is_integer() const noexcept { return fmpz_is_one(fmpq_denref(value_)) != 0; }
  /// Returns the bits of the numerator and the denominator together.
  [[nodiscard]] std::size_t bits() const noexcept {
    return fmpz_bits(fmpq_numref(value_)) + fmpz_bits(fmpq_denref(value_));
  }
  [[nodiscard]] std::string text() const {
    char* raw = fmpq_get_str(nullptr, 10, value_);
    std::string result(raw);
    flint_free(raw);
    return result;
  }

 private:
  fmpq_t value_;
};

inline Rational operator+(const Rational& x, const Rational& y) noexcept {
  Rational result;
  fmpq_add(result.get(), x.get(), y.get());
  return result;
}
inline Rational operator-(const Rational& x, const Rational& y) noexcept {
  Rational result;
  fmpq_sub(result.get(), x.get(), y.get());
  return result;
}
inline Rational operator*(const Rational& x, const Rational& y) noexcept {
  Rational result;
  fmpq_mul(result.get(), x.get(), y.get());
  return result;
}
/// Requires  y ≠ 0.
inline Rational operator/(const Rational& x, const Rational& y) noexcept {
  Rational result;
  fmpq_div(result.get(), x.get(), y.get());
  return result;
}
inline bool operator==(const Rational& x, const Rational& y) noexcept {
  return fmpq_equal(x.get(), y.get()) != 0;
}

/// Returns the exact value of a finite double.
inline Rational rational_of(double x) noexcept {
  Rational result;
  arf_t value;
  arf_init(value);
  arf_set_d(value, x);
  arf_get_fmpq(result.get(), value);
  arf_clear(value);
  return result;
}

}  // namespace regulus::verifier
