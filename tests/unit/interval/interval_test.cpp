// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the guarantees of the interval type in edge cases.
#include "runtime/interval/interval.hpp"

#include <gtest/gtest.h>

#include <climits>
#include <limits>

namespace regulus::detail {
namespace {

const double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Interval, WidensToEverythingWhenBuiltFromWhatIsNoSet) {
  EXPECT_EQ(Interval(kNaN), kEntire);
  EXPECT_EQ(Interval(kNaN, 1), kEntire);
  EXPECT_EQ(Interval(1, kNaN), kEntire);
  EXPECT_EQ(Interval(2, 1), kEntire);
  EXPECT_EQ(Interval(kInfinity), kEntire);
  EXPECT_EQ(Interval(-kInfinity), kEntire);
}

TEST(Interval, AnswersForAllPointsAndForSome) {
  const Interval low(1, 2), touching(2, 3), high(2.5, 4);
  EXPECT_TRUE(certain_less(low, high));
  EXPECT_FALSE(certain_less(low, touching));
  EXPECT_TRUE(certain_less_equal(low, touching));
  EXPECT_TRUE(possibly_less(low, touching));
  EXPECT_FALSE(possibly_less(touching, low));
  EXPECT_TRUE(possibly_less_equal(touching, low));
  EXPECT_TRUE(certain_positive(low));
  EXPECT_FALSE(certain_positive(Interval(0, 1)));
  EXPECT_TRUE(certain_nonnegative(Interval(0, 1)));
  EXPECT_FALSE(certain_nonnegative(Interval(-kMinSubnormal, 1)));
  EXPECT_TRUE(possibly_negative(Interval(-kMinSubnormal, 1)));
}

TEST(Interval, IntersectsInPointsAndInNothing) {
  EXPECT_EQ(intersect(Interval(1, 2), Interval(2, 3)), Interval(2));
  EXPECT_EQ(intersect(Interval(1, 2), Interval(3, 4)), std::nullopt);
  EXPECT_EQ(hull(Interval(1, 2), Interval(3, 4)), Interval(1, 4));
}

TEST(Interval, KnowsItsMagnitudes) {
  EXPECT_EQ(mag(Interval(-3, 2)), 3);
  EXPECT_EQ(mig(Interval(-3, 2)), 0);
  EXPECT_EQ(mig(Interval(-3, -2)), 2);
  EXPECT_EQ(width_ru(Interval(-kMaxDouble, kMaxDouble)), kInfinity);
  EXPECT_EQ(mid(kEntire), 0);
  EXPECT_EQ(mid(Interval(1, kInfinity)), kMaxDouble);
  EXPECT_EQ(mid(Interval(-kInfinity, 1)), -kMaxDouble);
}

TEST(Interval, IsNotSplitWhenNoDoubleLiesBetween) {
  EXPECT_FALSE(bisect(Interval(1)));
  EXPECT_FALSE(bisect(Interval(1, next_up(1))));
  EXPECT_FALSE(bisect(Interval(0, kMinSubnormal)));
  EXPECT_TRUE(bisect(Interval(0, 2 * kMinSubnormal)));
  EXPECT_TRUE(bisect(Interval(-kMaxDouble, kMaxDouble)));
}

TEST(Rounding, StepsThroughZeroAndStopsAtInfinity) {
  EXPECT_EQ(next_up(0.0), kMinSubnormal);
  EXPECT_EQ(next_up(-0.0), kMinSubnormal);
  EXPECT_EQ(next_down(0.0), -kMinSubnormal);
  EXPECT_EQ(next_up(-kMinSubnormal), 0);
  EXPECT_EQ(next_up(kMaxDouble), kInfinity);
  EXPECT_EQ(next_up(kInfinity), kInfinity);
  EXPECT_EQ(next_up(-kInfinity), -kMaxDouble);
}

TEST(Rounding, BoundsAnOverflowFromBothSides) {
  EXPECT_EQ(add_rd(kMaxDouble, kMaxDouble), kMaxDouble);
  EXPECT_EQ(add_ru(kMaxDouble, kMaxDouble), kInfinity);
  EXPECT_EQ(mul_rd(kMaxDouble, -2), -kInfinity);
  EXPECT_EQ(mul_ru(kMaxDouble, -2), -kMaxDouble);
  EXPECT_EQ(div_rd(1, kMinSubnormal), kMaxDouble);
  EXPECT_EQ(div_ru(1, kMinSubnormal), kInfinity);
}

TEST(Arithmetic, TreatsUnboundedEndsAsLimits) {
  const Interval ray(1, kInfinity);
  EXPECT_EQ(ray + ray, Interval(2, kInfinity));
  EXPECT_EQ(ray - ray, kEntire);
  EXPECT_EQ(ray * Interval(0, 1), Interval(0, kInfinity));
  EXPECT_EQ(Interval(0.0) * kEntire, Interval(0.0));
  EXPECT_EQ(Interval(1.0) / ray, Interval(0, 1));
  EXPECT_EQ(ray / ray, Interval(0, kInfinity));
  EXPECT_EQ(-Interval(3) / ray, Interval(-3, 0));
  EXPECT_EQ(sqrt(ray), ray);
}

TEST(Arithmetic, TellsWhenItIsUndefined) {
  bool undefined = false;
  EXPECT_EQ(div(Interval(1.0), Interval(1, 2), undefined), Interval(0.5, 1));
  EXPECT_EQ(sqrt(Interval(0, 4), undefined), Interval(0, 2));
  EXPECT_FALSE(undefined);
  EXPECT_EQ(div(Interval(1.0), Interval(0, 2), undefined), kEntire);
  EXPECT_TRUE(undefined);
  undefined = false;
  EXPECT_EQ(sqrt(Interval(-kMinSubnormal, 4), undefined), kEntire);
  EXPECT_TRUE(undefined);
  EXPECT_EQ(sqrt(Interval(1.0), undefined), Interval(1.0));
  EXPECT_TRUE(undefined) << "a defined operation must not clear what an earlier one reported";
}

TEST(Power, CoversSignsParityAndNegativeExponents) {
  EXPECT_EQ(pow(Interval(-2, 3), 0), Interval(1.0));
  EXPECT_EQ(pow(Interval(-2, 3), 2), Interval(0, 9));
  EXPECT_EQ(pow(Interval(-2, 3), 3), Interval(-8, 27));
  EXPECT_EQ(pow(Interval(-4, -2), -1), Interval(-0.5, -0.25));
  EXPECT_EQ(pow(Interval(2, 4), -2), Interval(0.0625, 0.25));
  bool undefined = false;
  EXPECT_EQ(pow(Interval(0, 1), -1, undefined), kEntire);
  EXPECT_TRUE(undefined);
}

TEST(Power, StaysDefinedWhenTheDenominatorUnderflows) {
  bool undefined = false;
  const Interval x = pow(Interval(0x1p-600), -2, undefined);
  EXPECT_FALSE(undefined);
  EXPECT_EQ(x.hi, kInfinity);
  EXPECT_EQ(x.lo, kMaxDouble);
  EXPECT_EQ(pow(Interval(-0x1p-600), -3, undefined).lo, -kInfinity);
  EXPECT_FALSE(undefined);
  EXPECT_EQ(pow(Interval(2.0), INT_MIN).lo, 0);
  EXPECT_LE(pow(Interval(2.0), INT_MIN).hi, 0x1p-1023);
}

}  // namespace
}  // namespace regulus::detail
