// SPDX-License-Identifier: GPL-3.0-or-later
// Tests exact values, domains and unbounded arguments of the elementary functions.
#include "runtime/interval/elementary.hpp"

#include <gtest/gtest.h>

namespace regulus::detail {
namespace {

const Interval kZero(0.0);
const Interval kUnit(-1, 1);
constexpr double kHalfPiUp = 0x1.921fb54442d19p+0;

TEST(Elementary, IsExactWhereTheValueIsADouble) {
  for (const Interval zero : {Interval(0.0), Interval(-0.0)}) {
    EXPECT_EQ(sin(zero), kZero);
    EXPECT_EQ(cos(zero), Interval(1.0));
    EXPECT_EQ(tan(zero), kZero);
    EXPECT_EQ(asin(zero), kZero);
    EXPECT_EQ(atan(zero), kZero);
    EXPECT_EQ(atan2(zero, Interval(3.0)), kZero);
    EXPECT_EQ(exp(zero), Interval(1.0));
  }
  EXPECT_EQ(log(Interval(1.0)), kZero);
  EXPECT_EQ(acos(Interval(1.0)), kZero);
}

TEST(Elementary, ReachesTheExtremaExactly) {
  EXPECT_EQ(sin(Interval(1, 2)).hi, 1);
  EXPECT_GT(sin(Interval(1, 2)).lo, 0.8);
  EXPECT_EQ(sin(Interval(4, 5)).lo, -1);
  EXPECT_EQ(sin(Interval(1, 5)), kUnit);
  EXPECT_EQ(sin(Interval(0, 6.5)), kUnit);
  EXPECT_EQ(cos(Interval(-1, 1)).hi, 1);
  EXPECT_EQ(cos(Interval(3, 4)).lo, -1);
  EXPECT_LT(cos(Interval(3, 4)).hi, -0.6);
  EXPECT_EQ(cos(Interval(-4, 1)), kUnit);
  EXPECT_EQ(sin(Interval(-kTrigonometricLimit, kTrigonometricLimit)), kUnit);
}

TEST(Elementary, DoesNotReduceBeyondTheLimit) {
  EXPECT_LT(width_ru(sin(Interval(kTrigonometricLimit))), 1e-15);
  const Interval beyond(next_up(kTrigonometricLimit));
  EXPECT_EQ(sin(beyond), kUnit);
  EXPECT_EQ(cos(Interval(-beyond.hi)), kUnit);
  EXPECT_EQ(cos(Interval(0, kInfinity)), kUnit);
  EXPECT_EQ(sin(kEntire), kUnit);
  bool undefined = false;
  EXPECT_EQ(tan(beyond, undefined), kEntire);
  EXPECT_TRUE(undefined);
}

TEST(Elementary, BothFormsOfSineAndCosineAgree) {
  const SinCos both = sincos(Interval(0.5, 2.25));
  EXPECT_EQ(both.sin, sin(Interval(0.5, 2.25)));
  EXPECT_EQ(both.cos, cos(Interval(0.5, 2.25)));
}

bool undefined_in(Interval (*f)(Interval, bool&), Interval x) {
  bool undefined = false;
  const Interval y = f(x, undefined);
  EXPECT_TRUE(!undefined || y == kEntire);
  return undefined;
}

TEST(Elementary, ReportsArgumentsOutsideTheDomain) {
  EXPECT_TRUE(undefined_in(tan, Interval(1.5, 1.6)));
  EXPECT_TRUE(undefined_in(tan, Interval(-2, -1)));
  EXPECT_TRUE(undefined_in(tan, Interval(0, 100)));
  EXPECT_FALSE(undefined_in(tan, Interval(2, 4)));
  EXPECT_FALSE(undefined_in(asin, kUnit));
  EXPECT_TRUE(undefined_in(asin, Interval(0, next_up(1))));
  EXPECT_TRUE(undefined_in(acos, Interval(next_down(-1), 0)));
  EXPECT_TRUE(undefined_in(acos, kEntire));
  EXPECT_FALSE(undefined_in(log, Interval(kMinSubnormal, 1)));
  EXPECT_TRUE(undefined_in(log, Interval(0, 1)));
  EXPECT_TRUE(undefined_in(log, Interval(-2, -1)));
  EXPECT_EQ(log(Interval(0, 1)), kEntire);
}

bool atan2_undefined(Interval y, Interval x) {
  bool undefined = false;
  static_cast<void>(atan2(y, x, undefined));
  return undefined;
}

TEST(Elementary, AngleIsUndefinedOnTheCutAndAtTheOriginOnly) {
  EXPECT_TRUE(atan2_undefined(kZero, kZero));
  EXPECT_TRUE(atan2_undefined(kZero, Interval(-1.0)));
  EXPECT_TRUE(atan2_undefined(Interval(0, 1), Interval(-2, -1)));
  EXPECT_TRUE(atan2_undefined(Interval(-1, 0), Interval(0, 1)));
  EXPECT_FALSE(atan2_undefined(Interval(kMinSubnormal, 1), Interval(-2, 2)));
  EXPECT_FALSE(atan2_undefined(Interval(-1, 1), Interval(kMinSubnormal, 2)));
}

TEST(Elementary, AngleCoversTheHalfPlanes) {
  const Interval upper = atan2(Interval(1, kInfinity), Interval(-kInfinity, kInfinity));
  EXPECT_LE(upper.lo, 0);
  EXPECT_GE(upper.hi, kPi.hi);
  EXPECT_LT(upper.hi, 3.1415926535898);
  EXPECT_EQ(atan2(Interval(0, 1), Interval(1, kInfinity)).lo, 0);
  const Interval lower = atan2(Interval(-2, -1), Interval(-1, 1));
  EXPECT_LT(lower.hi, -0.78);
  EXPECT_GT(lower.lo, -2.7);
}

TEST(Elementary, TakesUnboundedArguments) {
  EXPECT_EQ(atan(kEntire), Interval(-kHalfPiUp, kHalfPiUp));
  EXPECT_EQ(exp(Interval(-kInfinity, 0)), Interval(0, 1));
  EXPECT_EQ(exp(kEntire), Interval(0, kInfinity));
  EXPECT_EQ(log(Interval(1, kInfinity)), Interval(0, kInfinity));
}

TEST(Elementary, ExponentialOverflowsAndUnderflowsOutward) {
  EXPECT_EQ(exp(Interval(710.0)), Interval(kMaxDouble, kInfinity));
  EXPECT_EQ(exp(Interval(1e300)), Interval(kMaxDouble, kInfinity));
  EXPECT_EQ(exp(Interval(-746.0)), Interval(0, kMinSubnormal));
  EXPECT_EQ(exp(Interval(-1e300)), Interval(0, kMinSubnormal));
}

}  // namespace
}  // namespace regulus::detail
