// SPDX-License-Identifier: GPL-3.0-or-later
// Compares atan2 on doubles and on rectangles with Arb, and eight at a time with one at a time.
#include <gtest/gtest.h>

#include "runtime/interval/elementary.hpp"
#include "tests/property/interval/eight_lanes.hpp"
#include "tests/support/arb_oracle.hpp"
#include "tests/support/corner_inputs.hpp"
#include "tests/support/ulps.hpp"

namespace regulus::detail::test {
namespace {

constexpr std::uint64_t kBudget = 4;

bool touches_cut(Interval y, Interval x) { return contains_zero(y) && x.lo <= 0; }

/// Uses that over a rectangle off the cut, the extremes of the angle are at its corners.
Interval true_angle(ArbOracle& arb, Interval y, Interval x) {
  if (is_thin(x) && is_thin(y)) return arb.tight_atan2(y.lo, x.lo);
  return hull(hull(arb.tight_atan2(y.lo, x.lo), arb.tight_atan2(y.lo, x.hi)),
              hull(arb.tight_atan2(y.hi, x.lo), arb.tight_atan2(y.hi, x.hi)));
}

LaneResult check(ArbOracle& arb, Interval y, Interval x) {
  bool undefined = false;
  const Interval angle = atan2(y, x, undefined);
  EXPECT_EQ(undefined, touches_cut(y, x))
      << ::testing::PrintToString(y) << ::testing::PrintToString(x);
  if (undefined) return {0.0, true};
  const Interval exact = true_angle(arb, y, x);
  EXPECT_TRUE(certain_subset(exact, angle))
      << ::testing::PrintToString(y) << ::testing::PrintToString(x)
      << ::testing::PrintToString(angle) << " does not contain " << ::testing::PrintToString(exact);
  EXPECT_LE(excess_ulps(angle, exact), kBudget)
      << ::testing::PrintToString(y) << ::testing::PrintToString(x);
  return as_lane(angle, false);
}

template <class Draw>
void check_batches(int count, Draw draw) {
  ArbOracle arb;
  for (int i = 0; i < count / 8 && !::testing::Test::HasFailure(); ++i) {
    LaneBlock<2> in;
    std::array<LaneResult, 8> expected;
    for (int lane = 0; lane < 8; ++lane) {
      const Interval y = draw();
      const Interval x = draw();
      in.set(0, lane, y);
      in.set(1, lane, x);
      expected[static_cast<std::size_t>(lane)] = check(arb, y, x);
    }
    expect_lanes(&X8Backend::atan2, in, expected);
  }
}

TEST(Atan2, EnclosesTheAngleOfPointsOfAnySize) {
  CornerInputs inputs(31);
  check_batches(100'000, [&] { return Interval(inputs.number()); });
}

TEST(Atan2, EnclosesTheAngleOfPointsOfSimilarSize) {
  CornerInputs inputs(32, -8, 8);
  check_batches(200'000, [&] { return Interval(inputs.uniform(-8, 8)); });
}

TEST(Atan2, EnclosesTheAnglesOfRectangles) {
  CornerInputs inputs(33, -100, 100);
  check_batches(100'000, [&] { return inputs.interval(); });
}

}  // namespace
}  // namespace regulus::detail::test
