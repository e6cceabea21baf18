// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/api/planted_singularity.hpp"

#include <gtest/gtest.h>

namespace regulus::detail::test {
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

TEST(PlantedSingularity, IsFoundOnAPath) {
  const Found found = find_planted(3, 10, 0.5, 0.99, "path");
  EXPECT_EQ(found.singular, found.robots);
  EXPECT_EQ(found.regular, 0);
}

template <class Plant>
void expect_all(std::uint64_t seed) {
  for (const char* motion : {"pose", "box", "path"})
    for (const bool alpha : {false, true}) {
      const Found found = find_plants<Plant>(seed++, 10, 0.1, 0.99, motion, alpha);
      EXPECT_EQ(found.singular, found.robots) << motion << ' ' << alpha;
      EXPECT_EQ(found.regular, 0) << motion << ' ' << alpha;
      for (const std::string& model : found.others) ADD_FAILURE() << model;
    }
}

TEST(PlantedSingularity, IsFoundInPlanarPlatforms) { expect_all<RandomPlanarPlatform>(21); }

TEST(PlantedSingularity, IsFoundInMatrices) { expect_all<RandomMatrixModel>(31); }

}  // namespace
}  // namespace regulus::detail::test
