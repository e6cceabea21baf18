// SPDX-License-Identifier: GPL-3.0-or-later
// Arms of five joints, which bring the tool to a place and its z axis to a direction. The oracles are forward
// kinematics in doubles and Newton's method from many starts.
#include <gmock/gmock.h>

#include "codegen/support/errors.hpp"
#include "tests/property/solve/coupled_arms.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::coupled_arms {
namespace {

/// Five joints, and a tool.
struct ToolArm {
  Arm arm;
  Vec xyz{};
  std::array<double, 4> quaternion{1, 0, 0, 0};

  [[nodiscard]] std::string text(const Numbers& q) const {
    std::string text = text_of(arm, q);
    return text.insert(
        text.find("joints ="),
        fmt::format("tool = {{ xyz = {}, quaternion = {} }}\n", list(xyz), list(quaternion)));
  }
  [[nodiscard]] Frame tool_at(const Numbers& q) const {
    return end_of(arm, q) * Frame{rotation_of(quaternion), xyz};
  }
};

Vec z_of(const Frame& frame) { return {frame.R[0][2], frame.R[1][2], frame.R[2][2]}; }

/// The gap between the tools, and two parts of the direction across that of the other.
struct ToolGap {
  const ToolArm& robot;
  const Frame tool;

  Numbers operator()(const Numbers& q) const {
    const Frame T = robot.tool_at(q);
    Numbers gap = {T.p[0] - tool.p[0], T.p[1] - tool.p[1], T.p[2] - tool.p[2]};
    for (std::size_t column = 0; column < 2; ++column)
      gap.push_back(inner(z_of(T), {tool.R[0][column], tool.R[1][column], tool.R[2][column]}));
    return gap;
  }
  [[nodiscard]] bool is_posture(const Numbers& q) const {
    const Frame T = robot.tool_at(q);
    double most = std::fabs(1 - inner(z_of(T), z_of(tool)));
    for (std::size_t i = 0; i < 3; ++i) most = std::fmax(most, std::fabs(T.p[i] - tool.p[i]));
    return most < 1e-8;
  }
};

ToolArm any_tool_arm(RandomSource& random, bool has_follower) {
  ToolArm robot;
  Vec axis{0, 0, 1};
  for (int i = 0; i < 5; ++i) {
    Joint joint;
    joint.xyz = random_vector(random);
    joint.axis = axis = random_axis(random, axis);
    robot.arm.push_back(joint);
  }
  if (has_follower)
    robot.arm.insert(robot.arm.begin() + 2, {.xyz = random_vector(random),
                                             .axis = robot.arm[1].axis,
                                             .leader = 1,
                                             .multiplier = -1,
                                             .offset = 0.25});
  robot.xyz = random_vector(random);
  for (double& part : robot.quaternion) part = random.between(-1, 1);
  return robot;
}

/// One whose tool can move in every direction if it turns about its axis.
ToolArm random_tool_arm(RandomSource& random, bool has_follower) {
  for (;;) {
    const ToolArm robot = any_tool_arm(random, has_follower);
    Arm six = robot.arm;
    six.push_back({.xyz = robot.xyz, .quaternion = robot.quaternion});
    if (std::fabs(determinant(six, random_values(random, six))) > 1e-3) return robot;
  }
}

/// How many solutions are these values; the last one, the turn of the tool, is not compared.
int count_of_five(const Solutions& solutions, const Numbers& q) {
  const Numbers periods(5, 2 * std::numbers::pi);
  return count_near(solutions, q, periods, 1e-6);
}

TEST(PosturesOfAnArmOfFiveJoints, AreThoseThatNewtonFinds) {
  RandomSource random(91);
  int complete = 0, verified_lists = 0;
  const int rounds = trials(4, 60);
  for (int round = 0; round < rounds; ++round) {
    const ToolArm robot = random_tool_arm(random, round % 4 == 3);
    const Numbers planted = random_values(random, robot.arm);
    const Frame tool = robot.tool_at(planted);
    const Certified made = certified(robot.text(planted));
    const Solutions& solutions = made.solutions;
    if (!is_complete(solutions)) continue;
    ++complete;
    ASSERT_EQ(solutions.unknowns.size(), 6U);
    EXPECT_EQ(solutions.unknowns.back().name, "turn");
    const ToolGap gap{robot, tool};
    EXPECT_EQ(count_of_five(solutions, planted), 1);
    for (const CertainSolution& s : solutions.found) {
      Numbers q = middle_of(s.values);
      // Behind its turn the tool has the orientation that is given.
      const Frame turned =
          robot.tool_at({q.begin(), q.begin() + 5}) * Frame{.R = turn_about({0, 0, 1}, q[5])};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(turned.R[i][j], tool.R[i][j], 1e-8);
      q.pop_back();
      EXPECT_TRUE(gap.is_posture(q));
      EXPECT_EQ(count_of_five(solutions, q), 1);
    }
    for (int start = 0; start < 60; ++start) {
      const Numbers found = newton(gap, random_values(random, robot.arm));
      if (!found.empty() && gap.is_posture(found)) {
        EXPECT_EQ(count_of_five(solutions, found), 1);
      }
    }
    if (made.text.empty()) continue;  // counted
    verified_lists += outcome(made.text, robot.text(planted)) == Outcome::kVerified;
  }
  EXPECT_GE(complete, rounds * 7 / 8);
  EXPECT_GE(verified_lists, rounds * 3 / 4);
}

TEST(ListsOfAnArmOfFiveJoints, AreOfThisToolAlone) {
  RandomSource random(92);
  const ToolArm robot = random_tool_arm(random, false);
  const std::string model = robot.text(random_values(random, robot.arm));
  const Certified made = certified(model);
  ASSERT_FALSE(made.text.empty());
  const std::string text = without_sum(made.text);
  EXPECT_EQ(outcome(text, model), Outcome::kVerified);
  const Lines genuine = lines_of(text);
  EXPECT_EQ(genuine[first(genuine, "claim")].find(
                "an arm of these five joints whose tool is at this place, with its z axis in this "
                "direction, has exactly "),
            6U);
  EXPECT_EQ(count_of(genuine, "turning-tool"), 1U);
  std::string tool = model.substr(model.find("tool = {"));
  tool = tool.substr(0, tool.find('\n'));
  for (const std::string& other : {std::string(""), replaced(tool, "xyz = [", "xyz = [1"),
                                   replaced(tool, "quaternion = [", "quaternion = [1")})
    EXPECT_NE(outcome(text, replaced(model, tool, other)), Outcome::kVerified) << other;
  Lines turns = genuine;
  std::string& line = turns[first(turns, "turning-tool")];
  line = replaced(line, "turning-tool", "joint") + " | 0 | 0 | 1";
  const std::string claim = "an arm of these six joints whose end is at this place";
  EXPECT_NE(
      outcome(joined(claiming(turns, "COMPLETE", claim.c_str(), "posture", "postures")), model),
      Outcome::kVerified);
  for (std::size_t k = 0; k < count_of(genuine, "solution"); ++k) {
    Lines fewer = genuine;
    fewer.erase(fewer.begin() + std::ptrdiff_t(first(genuine, "solution") + k));
    const std::string robot_claim = format::describe_arm(6, true, false, false);
    const char* verdict = count_of(fewer, "solution") == 0 ? "NONE" : "COMPLETE";
    EXPECT_NE(outcome(joined(claiming(fewer, verdict, robot_claim.c_str(), "posture", "postures"))),
              Outcome::kVerified);
  }
}

/// An arm of six joints that holds its first one is the arm of the five behind it.
TEST(AnArmThatHoldsOneOfSixJoints, IsOneOfFive) {
  RandomSource random(94);
  const ToolArm five = random_tool_arm(random, false);
  ToolArm six = five;
  six.arm.insert(six.arm.begin(), {.xyz = {0.1, 0.2, 0.3}, .axis = {0, 3, 4}});
  Numbers planted = random_values(random, six.arm);
  ModelOptions options;
  options.text = six.text(planted);
  SearchOptions search;
  search.threads = 1;
  SolveRun run{search, {}};
  run.held = {"q1"};
  const Solutions held = solve(read_solve_request(options, {}, run.held), run);
  planted.erase(planted.begin());
  const Solutions known = solved(five.text(planted));
  ASSERT_TRUE(is_complete(held)) << held.obstacle;
  ASSERT_TRUE(is_complete(known));
  EXPECT_EQ(held.found.size(), known.found.size());
  for (const CertainSolution& s : known.found)
    EXPECT_EQ(count_of_five(held, middle_of({s.values.begin(), s.values.begin() + 5})), 1);
}

/// Where the last joint turns about the tool's axis, nothing fixes it.
TEST(AnArmOfFiveJoints, IsRefusedIfTheLastTurnsAboutTheToolsAxis) {
  RandomSource random(93);
  ToolArm robot = random_tool_arm(random, false);
  robot.arm.back().axis = {0, 0, 1};
  robot.xyz = {0, 0, 0.1}, robot.quaternion = {1, 0, 0, 0};
  EXPECT_THAT(
      [&] {
        (void)solved(robot.text({0.1, 0.2, 0.3, 0.4, 0.5}));
      },
      testing::ThrowsMessage<UsageError>(
          testing::HasSubstr("the last one turns about the z axis of the tool")));
  robot.xyz = {0.01, 0, 0.1};
  EXPECT_TRUE(is_complete(solved(robot.text({0.1, 0.2, 0.3, 0.4, 0.5}))));
}

}  // namespace
}  // namespace regulus::detail::test::coupled_arms
