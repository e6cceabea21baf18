// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/time_budget.hpp"

#include <gtest/gtest.h>

namespace regulus::detail::test {
namespace {

TEST(ATimeBudget, IsSharedEqually) {
  const TimeBudget all(100);
  EXPECT_NEAR(all.share(4).left(), 25, 1);
  EXPECT_NEAR(all.share(4).all(), 100, 1);
  EXPECT_LE(all.share(4).left(), all.left() / 4 + 1e-9);
}

TEST(ATimeBudget, LeavesAllTheTimeForWhatMustBeFormed) {
  const TimeBudget part(1, 50);
  EXPECT_LE(part.left(), 1);
  EXPECT_NEAR(part.all(), 50, 1);
  EXPECT_NEAR(TimeBudget(20, 5).all(), 20, 1);
}

TEST(ATimeBudget, ThatIsOverGrantsALeastSearchIfAllTheWorkHasTime) {
  TimeBudget part(0, 50);
  EXPECT_TRUE(part.is_over());
  part.grant_least();
  EXPECT_GT(part.left(), 0.4);
  EXPECT_LE(part.left(), 0.5);
  TimeBudget over(0, 0);
  over.grant_least();
  EXPECT_TRUE(over.is_over());
  TimeBudget longer(30);
  longer.grant_least();
  EXPECT_GT(longer.left(), 20);
}

TEST(ATimeBudget, OfAnOptionOfZeroHasNoEnd) {
  const TimeBudget none = TimeBudget::of_option(0);
  EXPECT_EQ(none.left(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(none.share(7).left(), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(TimeBudget::of_option(3).left(), 3, 1);
  EXPECT_GT(TimeBudget::option(0), 0);
  EXPECT_EQ(TimeBudget::option(2), 2);
}

}  // namespace
}  // namespace regulus::detail::test
