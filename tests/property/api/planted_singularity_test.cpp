// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/api/planted_singularity.hpp"

#include <gtest/gtest.h>

namespace regulus::test {
namespace {

TEST(PlantedSingularity, IsFoundAtTheEndOfTheTolerance) {
  const Found found = find_planted(1, 20, 0.95, 0.99, "pose");
  EXPECT_EQ(found.singular, found.robots);
  EXPECT_EQ(found.regular, 0);
}

TEST(PlantedSingularity, IsFoundInABoxOfPoses) {
  const Found found = find_planted(2, 10, 0.5, 0.99, "box");
  EXPECT_EQ(found.singular, found.robots);
  EXPECT_EQ(found.regular, 0);
}

}  // namespace
}  // namespace regulus::test
