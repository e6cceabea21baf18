// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/interval_arithmetic.hpp"

#include <stdexcept>

#include "codegen/kernel/program/rational_bounds.hpp"

namespace regulus::detail {

Interval IntervalArithmetic::constant(const cln::cl_RA& value) const { return enclose(value); }

Interval IntervalArithmetic::guarded(Interval result) noexcept {
  if (!(mag(result) <= largest_)) undefined_ = true;
  return result;
}

Interval IntervalArithmetic::divide(Interval a, Interval b) noexcept {
  return guarded(div(a, b, undefined_));
}

Interval IntervalArithmetic::power(Interval a, unsigned exponent) const noexcept {
  return exponent == 2 ? sqr(a) : pow(a, static_cast<int>(exponent));
}

Interval IntervalArithmetic::atan2(Interval a, Interval b) noexcept {
  return guarded(regulus::atan2(a, b, undefined_));
}

Interval IntervalArithmetic::call(Op function, Interval a) {
  switch (function) {
    case Op::kSqrt:
      return guarded(sqrt(a, undefined_));
    case Op::kSin:
      return sin(a);
    case Op::kCos:
      return cos(a);
    case Op::kTan:
      return guarded(tan(a, undefined_));
    case Op::kAsin:
      return guarded(asin(a, undefined_));
    case Op::kAcos:
      return guarded(acos(a, undefined_));
    case Op::kAtan:
      return atan(a);
    case Op::kExp:
      return guarded(exp(a));
    case Op::kLog:
      return guarded(log(a, undefined_));
    case Op::kAbs:
      return abs(a);
    default:
      throw std::out_of_range("not a function of one argument");
  }
}

}  // namespace regulus::detail
