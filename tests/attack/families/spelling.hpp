// SPDX-License-Identifier: GPL-3.0-or-later
// A number in one of the many ways in which a model file may write it.
#pragma once

#include <optional>
#include <string>

#include "tests/attack/oracle/random.hpp"
#include "tests/attack/oracle/rational.hpp"

namespace regulus::attack {

/// value = digits · 10^exponent, without trailing zeros.
struct Decimal {
  std::string digits;
  long exponent = 0;
  bool negative = false;
};

/// Nothing where the decimals do not end, or there are more than 300.
[[nodiscard]] std::optional<Decimal> decimal_of(const Rational& value);

/// An expression without spaces, in brackets where it is negative or a fraction.
[[nodiscard]] std::string spell_expression(const Rational& value, Random& random);

/// A TOML value: a number in any spelling, or an expression in a string.
[[nodiscard]] std::string spell_toml(const Rational& value, Random& random);

/// A TOML number, if the value is one of at most 60 digits: never a string.
[[nodiscard]] std::optional<std::string> spell_bare(const Rational& value, Random& random);

/// 2^exponent as an expression, by exponents of at most 100.
[[nodiscard]] std::string power_of_two(long exponent);

/// As an option of the command has it: no string, no fractions in brackets.
[[nodiscard]] std::string spell_option(const Rational& value, Random& random);

}  // namespace regulus::attack
