// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/arb_arithmetic.hpp"

#include <stdexcept>

namespace regulus::detail {
namespace {

/// |a| − 1.
Ball beyond_one(const Ball& a, long precision) {
  Ball result;
  arb_abs(result.get(), a.get());
  arb_sub_ui(result.get(), result.get(), 1, precision);
  return result;
}

// If a ball is not finite, its value is already lost: no violation is certain.
bool certain_negative(const Ball& a) { return arb_is_finite(a.get()) && arb_is_negative(a.get()); }
bool certain_positive(const Ball& a) { return arb_is_finite(a.get()) && arb_is_positive(a.get()); }
bool certain_nonpositive(const Ball& a) {
  return arb_is_finite(a.get()) && arb_is_nonpositive(a.get());
}

}  // namespace

Ball ArbArithmetic::pi() const {
  Ball result;
  arb_const_pi(result.get(), precision_);
  return result;
}

Ball ArbArithmetic::negate(const Ball& a) const {
  Ball result;
  arb_neg(result.get(), a.get());
  return result;
}

Ball ArbArithmetic::add(const Ball& a, const Ball& b) const {
  Ball result;
  arb_add(result.get(), a.get(), b.get(), precision_);
  return result;
}

Ball ArbArithmetic::subtract(const Ball& a, const Ball& b) const {
  Ball result;
  arb_sub(result.get(), a.get(), b.get(), precision_);
  return result;
}

Ball ArbArithmetic::multiply(const Ball& a, const Ball& b) const {
  Ball result;
  arb_mul(result.get(), a.get(), b.get(), precision_);
  return result;
}

Ball ArbArithmetic::divide(const Ball& a, const Ball& b) {
  require(!arb_contains_zero(b.get()), arb_is_zero(b.get()));
  Ball result;
  arb_div(result.get(), a.get(), b.get(), precision_);
  return result;
}

Ball ArbArithmetic::power(const Ball& a, unsigned exponent) const {
  Ball result;
  arb_pow_ui(result.get(), a.get(), exponent, precision_);
  return result;
}

Ball ArbArithmetic::atan2(const Ball& a, const Ball& b) {
  require(arb_is_nonzero(a.get()) || arb_is_positive(b.get()),
          arb_is_zero(a.get()) && certain_nonpositive(b));
  Ball result;
  arb_atan2(result.get(), a.get(), b.get(), precision_);
  return result;
}

void ArbArithmetic::require_domain(Op function, const Ball& a) {
  switch (function) {
    case Op::kSqrt:
      return require(arb_is_nonnegative(a.get()), certain_negative(a));
    case Op::kLog:
      return require(arb_is_positive(a.get()), certain_nonpositive(a));
    case Op::kAsin:
    case Op::kAcos: {
      const Ball beyond = beyond_one(a, precision_);
      return require(arb_is_nonpositive(beyond.get()), certain_positive(beyond));
    }
    case Op::kTan: {
      Ball cosine;
      arb_cos(cosine.get(), a.get(), precision_);
      return require(!arb_contains_zero(cosine.get()), false);
    }
    default:
      return;
  }
}

Ball ArbArithmetic::call(Op function, const Ball& a) {
  require_domain(function, a);
  Ball result;
  const auto apply = [&](void (*operation)(arb_t, const arb_t, slong)) {
    operation(result.get(), a.get(), precision_);
  };
  switch (function) {
    case Op::kSqrt:
      apply(arb_sqrt);
      break;
    case Op::kSin:
      apply(arb_sin);
      break;
    case Op::kCos:
      apply(arb_cos);
      break;
    case Op::kTan:
      apply(arb_tan);
      break;
    case Op::kAsin:
      apply(arb_asin);
      break;
    case Op::kAcos:
      apply(arb_acos);
      break;
    case Op::kAtan:
      apply(arb_atan);
      break;
    case Op::kExp:
      apply(arb_exp);
      break;
    case Op::kLog:
      apply(arb_log);
      break;
    case Op::kAbs:
      arb_abs(result.get(), a.get());
      break;
    default:
      throw std::out_of_range("not a function of one argument");
  }
  return result;
}

}  // namespace regulus::detail
