// SPDX-License-Identifier: Apache-2.0
// Monotone functions are enclosed by their values at the two ends, sine and cosine also by the
// extrema that may lie between. Every value comes from Arb at a point, with its own error bound.
#include "runtime/verifier/elementary.hpp"

#include "runtime/verifier/ball.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfFunction = 64;

Interval at(ArbFunction f, double x) {
  Ball ball(point(x), kBitsOfFunction);
  f(ball.get(), ball.get(), kBitsOfFunction);
  return ball.enclosure();
}

Interval at_ends(ArbFunction f, Interval x) { return hull(at(f, x.lo), at(f, x.hi)); }

/// Returns true if (x − offset·π)/(2π) may contain an integer; offset is 0 or ±1/2.
bool may_reach(Interval x, double offset) {
  const Interval turns = (x - offset * enclose_pi()) / (2.0 * enclose_pi());
  return std::floor(turns.hi) >= std::ceil(turns.lo);
}

/// Encloses a function with values in [−1, 1], maxima at `top`·π + 2kπ and minima at `bottom`·π +
/// 2kπ. Between them it is monotone.
Interval wave(ArbFunction f, Interval x, double top, double bottom) {
  Interval value = at_ends(f, x);
  if (may_reach(x, top)) value.hi = 1.0;
  if (may_reach(x, bottom)) value.lo = -1.0;
  return {std::max(value.lo, -1.0), std::min(value.hi, 1.0)};
}

/// The tangent increases between two poles. If cos ≠ 0 all over x, there is no pole in x.
Interval tangent(Interval x) {
  return contains(apply(Op::kCos, x), 0.0) ? everything() : at_ends(arb_tan, x);
}

}  // namespace

Interval enclose_pi() {
  static const Interval pi = [] {
    Ball ball;
    arb_const_pi(ball.get(), kBitsOfFunction);
    return ball.enclosure();
  }();
  return pi;
}

Interval enclose(const Rational& value) {
  Ball ball;
  arb_set_fmpq(ball.get(), value.get(), kBitsOfFunction);
  return ball.enclosure();
}

ArbFunction function_in_arb(Op function) {
  switch (function) {
    case Op::kSqrt:
      return arb_sqrt;
    case Op::kSin:
      return arb_sin;
    case Op::kCos:
      return arb_cos;
    case Op::kTan:
      return arb_tan;
    case Op::kAsin:
      return arb_asin;
    case Op::kAcos:
      return arb_acos;
    case Op::kAtan:
      return arb_atan;
    case Op::kExp:
      return arb_exp;
    case Op::kLog:
      return arb_log;
    default:
      throw std::logic_error("not a function of one argument");
  }
}

Interval apply(Op function, Interval x) {
  bool defined = true;
  switch (function) {
    case Op::kSin:
      return wave(arb_sin, x, 0.5, -0.5);
    case Op::kCos:
      return wave(arb_cos, x, 0.0, 1.0);
    case Op::kTan:
      return tangent(x);
    case Op::kAbs:
      return {mig(x), mag(x)};
    case Op::kSqrt:
      return x.lo >= 0.0 ? sqrt(x) : everything();
    case Op::kLog:
      defined = x.lo > 0.0;
      break;
    case Op::kAsin:
    case Op::kAcos:
      defined = x.lo >= -1.0 && x.hi <= 1.0;
      break;
    default:
      break;
  }
  return defined ? at_ends(function_in_arb(function), x) : everything();
}

Interval apply_atan2(Interval y, Interval x) {
  if (!(x.lo > 0.0) && contains(y, 0.0)) return everything();
  Ball ordinate(y, kBitsOfFunction), abscissa(x, kBitsOfFunction), angle;
  arb_atan2(angle.get(), ordinate.get(), abscissa.get(), kBitsOfFunction);
  return angle.enclosure();
}

}  // namespace regulus::verifier
