// SPDX-License-Identifier: GPL-3.0-or-later
// All postures of arms with four joints that turn about one direction alone: SCARA robots, and palletizing arms
// whose parallelograms keep the tool level. The oracles are those of coupled_arms.hpp.
#include "tests/property/solve/level_arms.hpp"

#include <gmock/gmock.h>

#include "codegen/support/errors.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::coupled_arms {
namespace {

TEST(PosturesOfAnArmThatTurnsAboutOneDirection, AreThoseThatNewtonFinds) {
  RandomSource random(61);
  for (int round = 0; round < trials(40, 400); ++round) {
    const Arm arm = round % 2 == 0 ? palletizer(random) : scara(random);
    const Numbers planted = random_values(random, arm);
    const Solutions solutions = solved(text_of(arm, planted));
    ASSERT_TRUE(is_complete(solutions)) << solutions.obstacle << text_of(arm, planted);
    EXPECT_LT(solutions.boxes, 2000U);
    expect_all(LevelGap{{arm, end_of(arm, planted)}}, arm, planted, solutions, random, 40);
  }
}

/// The end is where the arm without followers has it, whose last angle turns as the others do.
TEST(PosturesOfAPalletizer, AreFourWhereItsArmIsFarFromItsLimits) {
  RandomSource random(62);
  Arm arm = palletizer(random);
  arm[1].xyz = {0.1, 0, 0}, arm[3].xyz = {};
  arm[2].xyz = {0, 0, 0.9}, arm[4].xyz = {0.9, 0, 0}, arm[5].xyz = {0.1, 0, -0.1};
  const Solutions solutions = solved(text_of(arm, {0.3, 0.2, 0.4, 1}));
  ASSERT_TRUE(is_complete(solutions));
  EXPECT_EQ(solutions.found.size(), 4U);
}

std::string with_tool(const Arm& arm, const std::string& tool) {
  const std::string text = text_of(arm, {0, 0, 0, 0});
  return text.substr(0, text.find("[motion.")) + "[motion.there]\ntool = [" + tool + "]\n";
}

TEST(APlaceOfTheTool, IsReachedByALevelArmIfItIsLevel) {
  RandomSource random(63);
  const Arm arm = palletizer(random);
  const Numbers planted = random_values(random, arm);
  const Frame end = end_of(arm, planted);
  const auto at = [&](const char* orientation) {
    return with_tool(arm, fmt::format("{:.17g}, {:.17g}, {:.17g}, {}", end.p[0], end.p[1], end.p[2],
                                      orientation));
  };
  const double yaw = std::atan2(end.R[1][0], end.R[0][0]);
  const Solutions level = solved(at(fmt::format("0, 0, {:.17g}", yaw).c_str()));
  ASSERT_TRUE(is_complete(level));
  EXPECT_EQ(count_near(level, planted, periods_of(arm), 1e-7), 1);
  for (const char* other : {"0.001, 0, 0.3", "\"pi\", 0, 0.3", "0, -1e-9, 0.3"}) {
    const Solutions none = solved(at(other));
    EXPECT_TRUE(is_complete(none));
    EXPECT_TRUE(none.found.empty());
  }
  EXPECT_THAT([&] { (void)solved(at("0, \"sqrt(2)*sqrt(3) - sqrt(6)\", 0.3")); },
              testing::ThrowsMessage<UsageError>(testing::HasSubstr("it is not shown")));
}

/// A tolerance of a length leaves the tool level, and one of an angle does not.
TEST(TubesOfALevelArm, HaveThePosturesOfOtherLengths) {
  RandomSource random(64);
  const Arm arm = palletizer(random);
  const Numbers planted = random_values(random, arm);
  std::string text = text_of(arm, planted);
  text.insert(text.find("joints ="), "length_tolerance = 1e-4\n");
  const Solutions tubes = solved(text), points = solved(text_of(arm, planted));
  ASSERT_TRUE(is_complete(tubes)) << tubes.obstacle;
  ASSERT_EQ(tubes.found.size(), points.found.size());
  for (int other = 0; other < 20; ++other) {
    Arm moved = arm;
    for (Joint& joint : moved)
      for (double& x : joint.xyz) x += random.between(-1e-4, 1e-4);
    const LevelGap gap{{moved, end_of(arm, planted)}};
    for (const CertainSolution& point : points.found) {
      const Numbers q = newton(gap, middle_of(point.values));
      ASSERT_FALSE(q.empty());
      EXPECT_TRUE(gap.is_posture(q));
      EXPECT_EQ(
          std::ranges::count_if(
              tubes.found, [&](const CertainSolution& tube) { return is_within(q, tube.values); }),
          1);
    }
  }
}

TEST(AnArmOfOtherJoints, IsRefusedByName) {
  RandomSource random(65);
  Arm arm = palletizer(random), tilting = arm;
  tilting.erase(tilting.begin() + 2);  // the tool is no longer level
  EXPECT_THAT(
      [&] {
        (void)solved(text_of(tilting, {0.1, 0.2, 0.3, 0.4}));
      },
      testing::ThrowsMessage<UsageError>(testing::HasSubstr(
          "4 joints are free to move, and a frame fixes six; postures are found of arms")));
  arm.push_back({.xyz = {0, 0, 0.1}, .axis = {0, 0, 1}});
  EXPECT_THAT(
      [&] {
        (void)solved(text_of(arm, {0.1, 0.2, 0.3, 0.4, 0.5}));
      },
      testing::ThrowsMessage<UsageError>(
          testing::HasSubstr("as the arm turns about one direction alone, a place fixes four")));
}

}  // namespace
}  // namespace regulus::detail::test::coupled_arms
