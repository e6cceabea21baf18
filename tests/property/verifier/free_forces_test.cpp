// SPDX-License-Identifier: GPL-3.0-or-later
// The verifier proves that forces hold a load, some of them without limits. The oracle is the one solution of
// a square system at random poses of a box, and forces that are planted where there are several.
#include <gtest/gtest.h>

#include <sstream>

#include "runtime/verifier/load_test.hpp"
#include "tests/support/free_rows.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

using namespace verifier;
using Robot = RobotWithFreeRows;

std::string written(double number) {
  std::ostringstream text;
  text.precision(17);
  text << number;
  return text.str();
}

std::string question_of(const Robot& robot, const Robot::Doubles& wrench) {
  const format::ClaimedSet set{robot.rows, Robot::kColumns, 0, false, false};
  std::string text = "regulus-certificate 1\nverdict PAVING\nclaim " +
                     format::describe_load_claim(set, format::kPaving) +
                     "\nmodel m\nsha256 -\nmotion m\nalpha 0\n";
  for (const char* const name : {"x", "y"})
    text += "parameter " + std::string(name) + " in -" + written(robot.radius) + " : " +
            written(robot.radius) + '\n';
  text += "pose x = x\npose y = y\nmatrix " + std::to_string(robot.rows) + " 6\n";
  for (std::size_t e = 0; e < robot.parts[0].size(); ++e)
    text += "entry " + written(robot.parts[0][e]) + " + (" + written(robot.parts[1][e]) +
            ")*x + (" + written(robot.parts[2][e]) + ")*y\n";
  text += "load l\n";
  for (const double w : wrench) text += "wrench " + written(w) + " +- 0\n";
  for (std::size_t i = 0; i < robot.rows; ++i)
    text += robot.is_free(i) ? "limits free\n" : "limits -1 : 1\n";
  return text + "proof\n";
}

/// Decides the whole range.
struct Decided {
  bool is_held = false, is_not_held = false;

  Decided(const Robot& robot, const Robot::Doubles& wrench) {
    std::istringstream stream(question_of(robot, wrench));
    Lines lines(stream);
    Question question;
    read_question(lines, question);
    const Variety variety = enclose_variety(question);
    LoadTest test(question, variety);
    is_held = test.decide(variety.outer, LoadTest::Claim::kHeld) == BoxAnswer::kProved;
    is_not_held = test.decide(variety.outer, LoadTest::Claim::kNotHeld) == BoxAnswer::kProved;
  }
};

TEST(VerifiedForcesWithoutLimits, HoldALoadWhereTheOnlySolutionDoes) {
  RandomSource random(43);
  int held = 0, refused = 0;
  for (int round = 0; round < trials(1500, 30'000); ++round) {
    const Robot robot(random, Robot::kColumns, 1 + random.below(3));
    const Robot::Doubles w = robot.held_wrench(random, random.between(0, 2));
    const Decided decided(robot, w);
    held += decided.is_held, refused += decided.is_not_held;
    for (int sample = 0; sample < 4; ++sample) {
      const double largest = robot.largest_force(robot.pose(random), w);
      if (largest == 0) continue;
      EXPECT_FALSE(decided.is_held && largest > 1 + 1e-6) << largest;
      EXPECT_FALSE(decided.is_not_held && largest < 1 - 1e-6) << largest;
    }
  }
  EXPECT_GE(held, 20);
  EXPECT_GE(refused, 20);
}

TEST(VerifiedForcesWithoutLimits, AreNeverSaidNotToHoldAPlantedLoad) {
  RandomSource random(44);
  int held = 0;
  for (int round = 0; round < trials(1500, 30'000); ++round) {
    const Robot robot(random, Robot::kColumns + 1 + random.below(2), 1 + random.below(3));
    const Decided decided(robot, robot.held_wrench(random, 0.999));
    EXPECT_FALSE(decided.is_not_held);
    held += decided.is_held;
  }
  EXPECT_GE(held, 20);
}

}  // namespace
}  // namespace regulus::detail::test
