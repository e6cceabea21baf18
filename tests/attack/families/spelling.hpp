// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a number in one of the many ways that a model file allows.
#pragma once

#include <optional>
#include <string>

#include "tests/attack/oracle/random.hpp"
#include "tests/attack/oracle/rational.hpp"

namespace regulus::detail::attack {

/// value = digits · 10^exponent, without trailing zeros.
struct Decimal {
  std::string digits;
  long exponent = 0;
  bool negative = false;
};

/// Returns nullopt if the decimals do not end, or if there are more than 300.
[[nodiscard]] std::optional<Decimal> decimal_of(const Rational& value);

/// Returns an expression without spaces, in brackets if it is negative or a fraction.
[[nodiscard]] std::string spell_expression(const Rational& value, Random& random);

/// Returns a TOML value: a number in any spelling, or an expression in a string.
[[nodiscard]] std::string spell_toml(const Rational& value, Random& random);

/// Returns a TOML number, never a string, if the value has at most 60 digits.
[[nodiscard]] std::optional<std::string> spell_bare(const Rational& value, Random& random);

/// Returns 2^exponent as an expression that uses exponents of at most 100.
[[nodiscard]] std::string power_of_two(long exponent);

/// Returns the value as an option of the command: no string, no fractions in brackets.
[[nodiscard]] std::string spell_option(const Rational& value, Random& random);

}  // namespace regulus::detail::attack
