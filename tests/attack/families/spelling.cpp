// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/families/spelling.hpp"

#include <algorithm>

#include "tests/attack/oracle/attack.hpp"

namespace regulus::detail::attack {
namespace {

constexpr std::size_t kMaxBareDigits = 60;
constexpr long kMaxDecimals = 300;

/// Returns the power of `base` in n, and divides n by it.
long divide_out(fmpz_t n, long base) {
  fmpz_t b;
  fmpz_init_set_si(b, base);
  const slong power = fmpz_remove(n, n, b);
  fmpz_clear(b);
  return power;
}

std::string in_base(const Rational& integer, int base) {
  char* text = fmpz_get_str(nullptr, base, fmpq_numref(integer.get()));
  std::string result(text);
  flint_free(text);
  return result;
}

std::string sign_of(const Decimal& d) { return d.negative ? "-" : ""; }

/// Returns, for example, "12.5"; adds zeros if the point lies outside the digits.
std::string positional(const Decimal& d) {
  std::string digits = d.digits;
  if (d.exponent >= 0) return digits + std::string(static_cast<std::size_t>(d.exponent), '0');
  const auto decimals = static_cast<std::size_t>(-d.exponent);
  if (digits.size() <= decimals) digits.insert(0, decimals + 1 - digits.size(), '0');
  return digits.substr(0, digits.size() - decimals) + "." + digits.substr(digits.size() - decimals);
}

std::string exponent_text(long exponent, Random& random) {
  std::string text = random.one_in(2) ? "e" : "E";
  if (exponent >= 0 && random.one_in(2)) text += "+";
  return text + std::to_string(exponent);
}

/// Returns, for example, "1.25e-3", "125e-5" or "0.00125e0": the point may be anywhere.
std::string scientific(const Decimal& d, Random& random) {
  const auto count = static_cast<long>(d.digits.size());
  const long after = random.between(0, count);  // digits after the point
  const std::string moved = positional({d.digits, -after, false});
  return moved + exponent_text(d.exponent + after, random);
}

std::string unsigned_text(const Decimal& d, Random& random) {
  const long point = d.exponent + static_cast<long>(d.digits.size());
  const bool short_enough = -40 < d.exponent && point < 40;
  std::string text = short_enough && !random.one_in(3) ? positional(d) : scientific(d, random);
  const bool has_point = text.find('.') != std::string::npos;
  if (has_point && text.find_first_of("eE") == std::string::npos && random.one_in(4))
    text += std::string(static_cast<std::size_t>(random.between(1, 12)), '0');
  return text;
}

/// Adds underscores between two digits, as TOML allows.
std::string with_underscores(const std::string& text, Random& random) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto is_digit = [&](std::size_t at) { return '0' <= text[at] && text[at] <= '9'; };
    if (i > 0 && is_digit(i) && is_digit(i - 1) && random.one_in(4)) result += '_';
    result += text[i];
  }
  return result;
}

std::string bare_integer(const Rational& value, Random& random) {
  switch (value.sign() < 0 ? 0 : random.below(6)) {
    case 1:
      return "0x" + in_base(value, 16);
    case 2:
      return "0o" + in_base(value, 8);
    case 3:
      return "0b" + in_base(value, 2);
    default:
      return with_underscores(value.fraction(), random);
  }
}

}  // namespace

std::optional<Decimal> decimal_of(const Rational& value) {
  if (value.is_zero()) return Decimal{"0", 0, false};
  fmpz_t rest;
  fmpz_init_set(rest, fmpq_denref(value.get()));
  const long decimals = std::max(divide_out(rest, 2), divide_out(rest, 5));
  const bool ends = fmpz_is_one(rest) != 0;
  fmpz_clear(rest);
  if (!ends || decimals > kMaxDecimals) return std::nullopt;
  Decimal d;
  d.negative = value.sign() < 0;
  d.digits = (value.magnitude() * Rational::ten_to(decimals)).fraction();
  d.exponent = -decimals;
  while (d.digits.size() > 1 && d.digits.back() == '0') {
    d.digits.pop_back();
    ++d.exponent;
  }
  return d;
}

std::string spell_expression(const Rational& value, Random& random) {
  const std::optional<Decimal> d = decimal_of(value);
  if (!d || (value.is_integer() && random.one_in(2))) {
    const std::string text = value.fraction();
    return value.is_integer() && value.sign() >= 0 ? text : "(" + text + ")";
  }
  const std::string text = sign_of(*d) + unsigned_text(*d, random);
  return d->negative ? "(" + text + ")" : text;
}

std::optional<std::string> spell_bare(const Rational& value, Random& random) {
  const Rational largest = Rational::two_to(63) - Rational(1);
  if (value.is_integer() && value.magnitude() <= largest && !random.one_in(3))
    return bare_integer(value, random);
  const std::optional<Decimal> d = decimal_of(value);
  if (!d || d->digits.size() > kMaxBareDigits) return std::nullopt;
  std::string text = unsigned_text(*d, random);
  // Without a point or exponent it would be an integer, which has 64 bits.
  if (text.find_first_of(".eE") == std::string::npos) text += ".0";
  if (random.one_in(3)) text = with_underscores(text, random);
  return (d->negative ? "-" : random.one_in(8) ? "+" : "") + text;
}

std::string spell_toml(const Rational& value, Random& random) {
  if (!random.one_in(3))
    if (const auto bare = spell_bare(value, random)) return *bare;
  return quoted(spell_expression(value, random));
}

std::string power_of_two(long exponent) {
  constexpr long kMost = 100;
  std::string text;
  for (long rest = exponent; rest != 0 || text.empty();) {
    const long part = std::clamp(rest, -kMost, kMost);
    text += (text.empty() ? "2^(" : "*2^(") + std::to_string(part) + ")";
    rest -= part;
  }
  return text;
}

std::string spell_option(const Rational& value, Random& random) {
  return spell_expression(value, random);
}

}  // namespace regulus::detail::attack
