// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/property/api/planted_singularity.hpp"

namespace regulus::detail::test {
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

template <class Plant>
void expect_most_plants(const char* what, std::uint64_t seed) {
  for (const char* motion : {"pose", "box", "path"})
    for (const bool alpha : {false, true})
      expect_most(fmt::format("{}, {}, {}", what, motion, alpha ? "threshold" : "zero").c_str(),
                  find_plants<Plant>(seed++, 200, 0.0, 0.99, motion, alpha));
}

TEST(PlantedSingularity, IsFoundInNearlyAllModels) {
  expect_most("paths, 50 to 99 %", find_planted(14, 200, 0.5, 0.99, "path"));
  expect_most_plants<RandomPlanarPlatform>("planar platforms", 41);
  expect_most_plants<RandomMatrixModel>("matrices", 51);
}

TEST(RandomHexapods, AreNearlyAllDecided) {
  for (const char* shape : {"box", "ball"})
    for (const char* motion : {"pose", "box"}) {
      const Decided decided = decide_hexapods(16, 100, shape, motion);
      EXPECT_GE(decided.certified + decided.refuted, 98) << shape << ", " << motion;
    }
}

}  // namespace
}  // namespace regulus::detail::test
