// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/decimal.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/rational.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "codegen/model/exact/lexer.hpp"

namespace regulus::detail {
namespace {

/// Only digits reach CLN's reader: its own syntax has radix prefixes and fractions.
cln::cl_I integer_of_digits(const std::string& digits) {
  const std::size_t first = digits.find_first_not_of('0');
  return first == std::string::npos ? cln::cl_I(0) : cln::cl_I(digits.c_str() + first);
}

/// Returns the value of a digit, 36 for any other character.
int digit_value(char c) {
  if ('0' <= c && c <= '9') return c - '0';
  if ('a' <= c && c <= 'z') return c - 'a' + 10;
  return 'A' <= c && c <= 'Z' ? c - 'A' + 10 : 36;
}

bool is_digit(char c) { return digit_value(c) < 10; }

/// Returns nullopt unless each underscore is between two digits of that base.
std::optional<std::string> without_underscores(std::string_view text, int base) {
  std::string rest;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '_') {
      rest += text[i];
      continue;
    }
    if (i == 0 || i + 1 == text.size()) return std::nullopt;
    if (digit_value(text[i - 1]) >= base || digit_value(text[i + 1]) >= base) return std::nullopt;
  }
  return rest;
}

std::optional<cln::cl_I> integer_of_base(std::string_view text, int base) {
  const std::optional<std::string> digits = without_underscores(text, base);
  if (!digits || digits->empty() || digits->size() > kMaxDigits) return std::nullopt;
  cln::cl_I value = 0;
  for (const char c : *digits) {
    if (digit_value(c) >= base) return std::nullopt;
    value = value * base + digit_value(c);
  }
  return value;
}

/// True for digits [. digits] [(e|E) [+|-] digits], without a 0 in front of another digit.
bool is_toml_decimal(std::string_view text) {
  std::size_t at = 0;
  const auto skip_digits = [&] {
    const std::size_t begin = at;
    while (at < text.size() && is_digit(text[at])) ++at;
    return at > begin;
  };
  if (!skip_digits() || (at > 1 && text.front() == '0')) return false;
  if (at < text.size() && text[at] == '.') {
    ++at;
    if (!skip_digits()) return false;
  }
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    if (!skip_digits()) return false;
  }
  return at == text.size();
}

std::optional<GiNaC::numeric> exact_magnitude(std::string_view literal) {
  for (const auto& [prefix, base] : {std::pair{"0x", 16}, std::pair{"0o", 8}, std::pair{"0b", 2}}) {
    if (!literal.starts_with(prefix)) continue;
    const std::optional<cln::cl_I> value = integer_of_base(literal.substr(2), base);
    return value ? std::optional(GiNaC::numeric(*value)) : std::nullopt;
  }
  const std::optional<std::string> digits = without_underscores(literal, 10);
  if (!digits || !is_toml_decimal(*digits)) return std::nullopt;
  return exact_decimal(*digits);
}

}  // namespace

std::optional<GiNaC::numeric> exact_decimal(std::string_view literal) {
  const std::size_t e = literal.find_first_of("eE");
  const std::string_view mantissa = literal.substr(0, e);
  if (mantissa.size() > kMaxDigits) return std::nullopt;

  int exponent = 0;
  if (e != std::string_view::npos) {
    std::string_view digits = literal.substr(e + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (error != std::errc{} || std::abs(exponent) > kMaxExponent) return std::nullopt;
  }

  const std::size_t point = mantissa.find('.');
  std::string digits(mantissa.substr(0, point));
  if (point != std::string_view::npos) {
    digits += mantissa.substr(point + 1);
    exponent -= static_cast<int>(mantissa.size() - point - 1);
  }
  return GiNaC::numeric(integer_of_digits(digits) * cln::expt(cln::cl_RA(10), exponent));
}

std::optional<GiNaC::numeric> signed_decimal(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const Token token = Lexer(text).next();
  if (token.kind != Token::Kind::kNumber || token.text.size() != text.size()) return std::nullopt;
  const auto value = exact_decimal(text);
  if (value && negative) return -*value;
  return value;
}

std::optional<GiNaC::numeric> exact_toml_number(std::string_view literal) {
  const bool negative = literal.starts_with('-');
  if (negative || literal.starts_with('+')) literal.remove_prefix(1);
  const std::optional<GiNaC::numeric> magnitude = exact_magnitude(literal);
  return magnitude && negative ? std::optional(-*magnitude) : magnitude;
}

GiNaC::numeric exact_value(double value) {
  constexpr int kBits = std::numeric_limits<double>::digits;
  int exponent = 0;
  const double significand = std::ldexp(std::frexp(value, &exponent), kBits);
  return GiNaC::numeric(cln::cl_I(static_cast<long long>(significand)) *
                        cln::expt(cln::cl_RA(2), exponent - kBits));
}

bool rounds_to(const GiNaC::numeric& exact, double nearest) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const GiNaC::numeric value = exact_value(nearest);
  const auto half_way = [&](double towards) {
    const double next = std::nextafter(nearest, towards);
    if (std::isfinite(next)) return (value + exact_value(next)) / 2;
    return value + (value - exact_value(std::nextafter(nearest, 0.0))) / 2;
  };
  return half_way(-kInfinity) <= exact && exact <= half_way(kInfinity);
}

GiNaC::numeric shortest_decimal(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), std::fabs(value)).ptr;
  const GiNaC::numeric magnitude = *exact_decimal({text.data(), end});
  return std::signbit(value) ? -magnitude : magnitude;
}

GiNaC::numeric exact_integer(std::int64_t value) {
  return GiNaC::numeric(cln::cl_I(static_cast<long long>(value)));
}

}  // namespace regulus::detail
