// SPDX-License-Identifier: GPL-3.0-or-later
// Tests for every elementary function: one interval at a time against Arb, and eight at a time, on
// each instruction set, against one at a time.
#pragma once

#include <gtest/gtest.h>

#include "tests/property/interval/eight_lanes.hpp"
#include "tests/property/interval/elementary_cases.hpp"
#include "tests/support/ulps.hpp"

namespace regulus::detail::test {

class ElementarySuite : public ::testing::TestWithParam<ElementaryCase> {
 protected:
  /// Checks one interval against the truth; returns the expected result of a lane.
  LaneResult check(Interval x) {
    const ElementaryCase& f = GetParam();
    const Truth truth = f.truth(arb_, x);
    bool undefined = false;
    const Interval value = f.scalar(x, undefined);
    EXPECT_EQ(undefined, truth.undefined) << ::testing::PrintToString(x);
    if (undefined) {
      EXPECT_EQ(value, kEntire);
    } else {
      EXPECT_TRUE(certain_subset(truth.range, value)) << where(x, value, truth.range);
      EXPECT_LE(excess_ulps(value, truth.range), f.budget) << where(x, value, truth.range);
    }
    return as_lane(value, undefined);
  }

  template <class Draw>
  void check_batches(int count, Draw draw) {
    for (int i = 0; i < count / 8 && !HasFailure(); ++i) {
      LaneBlock<1> in;
      std::array<LaneResult, 8> expected;
      for (int lane = 0; lane < 8; ++lane) {
        const Interval x = draw();
        in.set(0, lane, x);
        expected[static_cast<std::size_t>(lane)] = check(x);
      }
      expect_lanes(GetParam().eight_lanes, in, expected);
    }
  }

 private:
  static std::string where(Interval x, Interval got, Interval tight) {
    return "at " + ::testing::PrintToString(x) + ": " + ::testing::PrintToString(got) + ", tight " +
           ::testing::PrintToString(tight);
  }

  ArbOracle arb_;
};

}  // namespace regulus::detail::test
