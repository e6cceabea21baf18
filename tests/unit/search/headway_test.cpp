// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/problem/headway.hpp"

#include <gtest/gtest.h>

namespace regulus::detail {
namespace {

constexpr std::uint64_t kRun = 1U << 20;

TEST(Headway, IsMadeWhereBoxesCloseTheirPart) {
  Headway headway;
  for (int k = 0; k < 1000; ++k) headway.close(21, Rule::kHMatrix);
  EXPECT_FALSE(headway.stalls(kRun, 3));
}

TEST(Headway, IsNotMadeByTinyBoxes) {
  Headway headway;
  for (int k = 0; k < 1000; ++k) headway.close(40, Rule::kHMatrix);
  EXPECT_FALSE(headway.stalls(kRun - 1, 3));
  EXPECT_TRUE(headway.stalls(kRun, 3));
  EXPECT_FALSE(headway.stalls(kRun + 1, 3)) << "the next run has begun";
  EXPECT_TRUE(headway.stalls(2 * kRun, 3));
}

TEST(Headway, IsNotJudgedByTinyBoxesOfManyVariables) {
  Headway headway;
  for (int k = 0; k < 1000; ++k) headway.close(60, Rule::kHMatrix);
  EXPECT_FALSE(headway.stalls(kRun, 4));
}

TEST(Headway, IsNotMadeByBoxesOfManyVariablesWithTinySides) {
  Headway headway;
  for (int k = 0; k < 1000; ++k) headway.close(127, Rule::kHMatrix);
  EXPECT_TRUE(headway.stalls(kRun, 4));
  for (int k = 0; k < 1000; ++k) headway.close(127, Rule::kHMatrix);
  EXPECT_FALSE(headway.stalls(2 * kRun, 6));
}

TEST(Headway, IsNotMadeByBoxesAtTheEndOfDoubles) {
  Headway headway;
  for (std::uint64_t k = 0; k < kRun / 16; ++k) headway.close(150, Rule::kMultiprecision);
  EXPECT_TRUE(headway.stalls(2 * (kRun / 16), 4));
}

TEST(Headway, IsJudgedByMostOfTheBoxes) {
  Headway headway;
  for (std::uint64_t k = 0; k < kRun / 16; ++k) headway.close(150, Rule::kMultiprecision);
  for (std::uint64_t k = 0; k < kRun / 16; ++k) headway.close(60, Rule::kHMatrix);
  EXPECT_FALSE(headway.stalls(kRun, 4));
}

TEST(Headway, ForgetsWhatWasClosedBeforeACheckpoint) {
  Headway headway;
  for (int k = 0; k < 1000; ++k) headway.close(5, Rule::kHMatrix);
  headway.begin(7);
  EXPECT_FALSE(headway.stalls(kRun, 3));
  EXPECT_TRUE(headway.stalls(kRun + 7, 3));
}

}  // namespace
}  // namespace regulus::detail
