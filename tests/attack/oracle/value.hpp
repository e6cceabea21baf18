// SPDX-License-Identifier: GPL-3.0-or-later
// The value of an expression: an exact rational if there is one, else a ball of Arb, or no value.
#pragma once

#include <arb.h>

#include <optional>
#include <string>

#include "tests/attack/oracle/rational.hpp"

namespace regulus::detail::attack {

/// Bits of a ball: enough for margins of 1e-300.
inline constexpr long kBits = 2200;

class Value {
 public:
  /// Makes a value that is not defined: the expression may be undefined.
  Value() { arb_init(ball_); }
  Value(const Rational& exact) : defined_(true), exact_(exact) {  // NOLINT: rationals are values
    arb_init(ball_);
    arb_set_fmpq(ball_, exact.get(), kBits);
  }
  /// A ball that is the number 0, as 0 times another is, is that rational.
  explicit Value(const arb_t ball) : defined_(arb_is_finite(ball) != 0) {
    if (arb_is_zero(ball)) exact_ = Rational(0);
    arb_init(ball_);
    arb_set(ball_, ball);
  }
  Value(const Value& other) : defined_(other.defined_), exact_(other.exact_) {
    arb_init(ball_);
    arb_set(ball_, other.ball_);
  }
  Value& operator=(const Value& other) {
    defined_ = other.defined_;
    exact_ = other.exact_;
    arb_set(ball_, other.ball_);
    return *this;
  }
  ~Value() { arb_clear(ball_); }

  [[nodiscard]] bool defined() const { return defined_; }
  [[nodiscard]] const std::optional<Rational>& exact() const { return exact_; }
  [[nodiscard]] const arb_struct* ball() const { return ball_; }

  /// Returns −1, 0 or 1; nullopt if the sign is not known. Only a rational gives 0.
  [[nodiscard]] std::optional<int> sign() const;
  /// Returns true if the value may be 0 and is known to at least 600 bits below `unit`.
  [[nodiscard]] bool is_zero_to(const Rational& unit) const;
  [[nodiscard]] bool certain_at_most(const Rational& bound) const;
  [[nodiscard]] bool certain_at_least(const Rational& bound) const;
  [[nodiscard]] std::string describe() const;

  friend Value operator+(const Value& a, const Value& b);
  friend Value operator-(const Value& a, const Value& b);
  friend Value operator*(const Value& a, const Value& b);
  friend Value operator/(const Value& a, const Value& b);

 private:
  bool defined_ = false;
  std::optional<Rational> exact_;
  arb_t ball_;
};

/// Returns no value unless base > 0, or the exponent is an integer and the power is defined.
[[nodiscard]] Value power(const Value& base, const Value& exponent);
[[nodiscard]] Value magnitude(const Value& x);
[[nodiscard]] Value pi();
/// Calls a function of the model language by its name; `y` is the second argument of atan2. atan2
/// has no value on its branch cut.
[[nodiscard]] Value call(const std::string& function, const Value& x, const Value& y);

}  // namespace regulus::detail::attack
