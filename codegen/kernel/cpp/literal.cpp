// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/literal.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace regulus::detail {
namespace {

// Prints from the bits, because the decimal point of printf depends on the locale.
std::string hexadecimal(double magnitude) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &magnitude, sizeof bits);
  const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
  const int biased = static_cast<int>(bits >> 52);
  std::string digits;
  for (int shift = 48; shift >= 0; shift -= 4)
    digits += "0123456789abcdef"[(fraction >> shift) & 15U];
  while (!digits.empty() && digits.back() == '0') digits.pop_back();
  const int exponent = biased == 0 ? -1022 : biased - 1023;
  return std::string(biased == 0 ? "0x0" : "0x1") + (digits.empty() ? "" : "." + digits) + "p" +
         (exponent < 0 ? "" : "+") + std::to_string(exponent);
}

}  // namespace

std::string literal(double x) {
  constexpr double kShort = 1000000.0;
  const std::string sign = x < 0 ? "-" : "";
  const double magnitude = std::fabs(x);
  if (std::isinf(x)) return sign + "__builtin_huge_val()";
  if (magnitude < kShort && magnitude == std::trunc(magnitude))
    return sign + std::to_string(static_cast<long>(magnitude)) + ".0";
  return sign + hexadecimal(magnitude);
}

std::string constant_literal(const Interval& x) {
  return "constant(" + literal(x.lo) + ", " + literal(x.hi) + ")";
}

}  // namespace regulus::detail
