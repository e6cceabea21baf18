// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of passive constraints have no limits. The oracle is the one solution of a square system at random
// poses of a box, and forces that are planted where there are several.
#include <gtest/gtest.h>

#include "codegen/question/load/force_test.hpp"
#include "runtime/interval/floating_point_scope.hpp"
#include "tests/support/free_rows.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::free_forces_test {
namespace {

using Kind = ForceDecision::Kind;
using Robot = RobotWithFreeRows;

Kind decide(const Robot& robot, const Robot::Doubles& wrench) {
  ForceProblem problem{robot.rows, Robot::kColumns, {}, {}, {}, {}, {}};
  for (std::size_t i = 0; i < robot.rows; ++i) {
    problem.is_free.push_back(robot.is_free(i));
    problem.certain.push_back(robot.is_free(i) ? kEntire : Interval(-1, 1));
  }
  problem.possible = problem.certain;
  problem.corners.emplace_back(wrench.begin(), wrench.end());
  BoxMatrix box{{robot.parts[0].begin(), robot.parts[0].end()},
                {},
                Robot::Doubles(Robot::kParameters, robot.radius)};
  for (std::size_t k = 1; k <= Robot::kParameters; ++k)
    box.slopes.insert(box.slopes.end(), robot.parts[k].begin(), robot.parts[k].end());
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  return ForceTest(problem).decide(box).kind;
}

TEST(ForcesWithoutLimits, HoldALoadWhereTheOnlySolutionDoes) {
  RandomSource random(41);
  int held = 0, refused = 0;
  for (int round = 0; round < trials(4000, 100'000); ++round) {
    const Robot robot(random, Robot::kColumns, 1 + random.below(3));
    const Robot::Doubles w = robot.held_wrench(random, random.between(0, 2));
    const Kind kind = decide(robot, w);
    if (kind == Kind::kUnknown) continue;
    ++(kind == Kind::kHeld ? held : refused);
    for (int sample = 0; sample < 4; ++sample) {
      const double largest = robot.largest_force(robot.pose(random), w);
      if (largest == 0) continue;
      EXPECT_TRUE(kind == Kind::kHeld ? largest < 1 + 1e-6 : largest > 1 - 1e-6) << largest;
    }
  }
  EXPECT_GE(held, 50);
  EXPECT_GE(refused, 50);
}

TEST(ForcesWithoutLimits, AreNeverSaidNotToHoldAPlantedLoad) {
  RandomSource random(42);
  int held = 0;
  for (int round = 0; round < trials(4000, 100'000); ++round) {
    const Robot robot(random, Robot::kColumns + 1 + random.below(2), 1 + random.below(3));
    const Kind kind = decide(robot, robot.held_wrench(random, 0.999));
    EXPECT_FALSE(kind == Kind::kNotHeld);
    held += kind == Kind::kHeld;
  }
  EXPECT_GE(held, 50);
}

}  // namespace
}  // namespace regulus::detail::test::free_forces_test
