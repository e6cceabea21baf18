// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/fold.hpp"

#include <cln/integer.h>

namespace regulus::detail {
namespace {

// Far beyond the precision of a double, and short enough to print.
constexpr std::uint64_t kMaxBits = 1U << 14;

std::uint64_t bits(const cln::cl_RA& value) {
  return cln::integer_length(cln::numerator(value)) + cln::integer_length(cln::denominator(value));
}

}  // namespace

std::optional<cln::cl_RA> fold_power(const cln::cl_RA& value, std::uint32_t exponent) {
  if (bits(value) * exponent > kMaxBits) return std::nullopt;
  return cln::expt(value, static_cast<cln::cl_I>(static_cast<unsigned long>(exponent)));
}

std::optional<cln::cl_RA> fold_call(Op function, const cln::cl_RA& value) {
  const bool zero = cln::zerop(value);
  cln::cl_RA root;
  switch (function) {
    case Op::kSqrt:
      if (!cln::minusp(value) && cln::sqrtp(value, &root)) return root;
      return std::nullopt;
    case Op::kAbs:
      return cln::abs(value);
    case Op::kSin:
    case Op::kTan:
    case Op::kAsin:
    case Op::kAtan:
      if (zero) return cln::cl_RA(0);
      return std::nullopt;
    case Op::kCos:
    case Op::kExp:
      if (zero) return cln::cl_RA(1);
      return std::nullopt;
    case Op::kAcos:
    case Op::kLog:
      if (value == 1) return cln::cl_RA(0);
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

}  // namespace regulus::detail
