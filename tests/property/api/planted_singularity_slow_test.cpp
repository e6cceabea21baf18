// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/property/api/planted_singularity.hpp"

namespace regulus::test {
namespace {

/// The rate is printed; a wrong NO SINGULARITY is an error.
void expect_most(const char* what, const Found& found) {
  std::printf("%s: %d of %d found\n", what, found.singular, found.robots);
  EXPECT_EQ(found.regular, 0);
  EXPECT_GE(found.singular, found.robots * 99 / 100);
}

TEST(PlantedSingularity, IsFoundInNearlyAllRobots) {
  expect_most("single poses, up to 50 % of the tolerance", find_planted(11, 400, 0.0, 0.5, "pose"));
  expect_most("single poses, 50 to 99 %", find_planted(12, 400, 0.5, 0.99, "pose"));
  expect_most("boxes of poses, 50 to 99 %", find_planted(13, 200, 0.5, 0.99, "box"));
}

}  // namespace
}  // namespace regulus::test
