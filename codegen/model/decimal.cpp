// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/model/decimal.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/rational.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace regulus::codegen {
namespace {

constexpr std::size_t kMostDigits = 1000;
constexpr int kLargestExponent = 1000;

/// Only digits reach CLN's reader: its own syntax has radix prefixes and fractions.
cln::cl_I integer_of_digits(const std::string& digits) {
  const std::size_t first = digits.find_first_not_of('0');
  return first == std::string::npos ? cln::cl_I(0) : cln::cl_I(digits.c_str() + first);
}

}  // namespace

std::optional<GiNaC::numeric> exact_decimal(std::string_view literal) {
  const std::size_t e = literal.find_first_of("eE");
  const std::string_view mantissa = literal.substr(0, e);
  if (mantissa.size() > kMostDigits) return std::nullopt;

  int exponent = 0;
  if (e != std::string_view::npos) {
    std::string_view digits = literal.substr(e + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (error != std::errc{} || std::abs(exponent) > kLargestExponent) return std::nullopt;
  }

  const std::size_t point = mantissa.find('.');
  std::string digits(mantissa.substr(0, point));
  if (point != std::string_view::npos) {
    digits += mantissa.substr(point + 1);
    exponent -= static_cast<int>(mantissa.size() - point - 1);
  }
  return GiNaC::numeric(integer_of_digits(digits) * cln::expt(cln::cl_RA(10), exponent));
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

}  // namespace regulus::codegen
