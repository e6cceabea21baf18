// SPDX-License-Identifier: GPL-3.0-or-later
// Exact rational numbers.
#pragma once

#include <flint/fmpq.h>

#include <compare>
#include <string>
#include <string_view>

namespace regulus::detail::attack {

class Rational {
 public:
  Rational(long numerator = 0, unsigned long denominator = 1) {  // NOLINT: integers are rationals
    fmpq_init(q_);
    fmpq_set_si(q_, numerator, denominator);
  }
  Rational(const Rational& other) {
    fmpq_init(q_);
    fmpq_set(q_, other.q_);
  }
  Rational(Rational&& other) noexcept {
    fmpq_init(q_);
    fmpq_swap(q_, other.q_);
  }
  Rational& operator=(const Rational& other) {
    fmpq_set(q_, other.q_);
    return *this;
  }
  Rational& operator=(Rational&& other) noexcept {
    fmpq_swap(q_, other.q_);
    return *this;
  }
  ~Rational() { fmpq_clear(q_); }

  /// Returns digits · 10^exponent; the digits may begin with a sign.
  static Rational decimal(std::string_view digits, long exponent);
  /// Reads digits in that base, 2 to 36.
  static Rational integer(std::string_view digits, int base);
  static Rational of(double value);
  static Rational ten_to(long exponent) { return Rational(10).to_the(exponent); }
  static Rational two_to(long exponent) { return Rational(2).to_the(exponent); }

  [[nodiscard]] const fmpq* get() const { return q_; }
  [[nodiscard]] fmpq* get() { return q_; }

  [[nodiscard]] int sign() const { return fmpq_sgn(q_); }
  [[nodiscard]] bool is_zero() const { return fmpq_is_zero(q_) != 0; }
  [[nodiscard]] bool is_integer() const { return fmpz_is_one(fmpq_denref(q_)) != 0; }
  [[nodiscard]] Rational magnitude() const { return sign() < 0 ? -*this : *this; }
  /// Requires  the number is not 0 if the exponent is negative.
  [[nodiscard]] Rational to_the(long exponent) const;
  /// Returns, for example, "-22/7".
  [[nodiscard]] std::string fraction() const;

  friend Rational operator+(const Rational& a, const Rational& b) {
    Rational r;
    fmpq_add(r.q_, a.q_, b.q_);
    return r;
  }
  friend Rational operator-(const Rational& a, const Rational& b) {
    Rational r;
    fmpq_sub(r.q_, a.q_, b.q_);
    return r;
  }
  friend Rational operator*(const Rational& a, const Rational& b) {
    Rational r;
    fmpq_mul(r.q_, a.q_, b.q_);
    return r;
  }
  /// Requires  b ≠ 0.
  friend Rational operator/(const Rational& a, const Rational& b) {
    Rational r;
    fmpq_div(r.q_, a.q_, b.q_);
    return r;
  }
  Rational operator-() const {
    Rational r;
    fmpq_neg(r.q_, q_);
    return r;
  }
  Rational& operator+=(const Rational& b) { return *this = *this + b; }
  Rational& operator-=(const Rational& b) { return *this = *this - b; }
  Rational& operator*=(const Rational& b) { return *this = *this * b; }

  friend bool operator==(const Rational& a, const Rational& b) {
    return fmpq_equal(a.q_, b.q_) != 0;
  }
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
    return fmpq_cmp(a.q_, b.q_) <=> 0;
  }

 private:
  fmpq_t q_;
};

}  // namespace regulus::detail::attack
