// SPDX-License-Identifier: GPL-3.0-or-later
// All postures of arms with joints that follow others. The oracles are forward kinematics in doubles, which
// shares nothing with the code under test, and Newton's method from many starts.
#include "tests/property/solve/coupled_arms.hpp"

#include <gmock/gmock.h>

#include "codegen/support/errors.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::coupled_arms {
namespace {

TEST(PosturesOfAnArmWithAFollower, AreThoseThatNewtonFinds) {
  RandomSource random(41);
  const int rounds = trials(4, 100);
  int complete = 0;
  for (int round = 0; round < rounds; ++round) {
    const Arm arm = random_arm(random, 1);
    const Numbers planted = random_values(random, arm);
    const Solutions solutions = solved(text_of(arm, planted));
    if (!is_complete(solutions)) continue;
    ++complete;
    expect_all(arm, planted, solutions, random, 60);
  }
  EXPECT_GE(complete, rounds - 1);
}

TEST(PosturesOfAnArmWithTwoFollowers, AreThoseThatNewtonFinds) {
  RandomSource random(44);
  const int rounds = trials(3, 40);
  int complete = 0;
  for (int round = 0; round < rounds; ++round) {
    const Arm arm = random_arm(random, 2);
    const Numbers planted = random_values(random, arm);
    const Solutions solutions = solved(text_of(arm, planted));
    if (!is_complete(solutions)) continue;
    ++complete;
    expect_all(arm, planted, solutions, random, 60);
  }
  EXPECT_GE(complete, rounds * 3 / 4);
}

/// With q3 + q2 in the place of q3 the same arm has no parallelogram.
TEST(PosturesOfAnArmWithAParallelogram, AreThoseWithoutIt) {
  for (int round = 0; round < trials(6, 60); ++round) {
    RandomSource one(std::uint64_t(round) + 50), other = one, random{std::uint64_t(round)};
    const Arm arm = usual_arm(one, true), plain = usual_arm(other, false);
    const Numbers planted = random_values(random, arm);
    Numbers moved = planted;
    moved[2] -= moved[1];
    const Solutions solutions = solved(text_of(arm, planted)),
                    known = solved(text_of(plain, moved));
    ASSERT_TRUE(is_complete(solutions)) << solutions.obstacle;
    ASSERT_TRUE(is_complete(known));
    EXPECT_EQ(solutions.found.size(), known.found.size());
    for (const CertainSolution& s : known.found) {
      Numbers values = middle_of(s.values);
      values[2] += values[1];
      EXPECT_EQ(count_near(solutions, values, periods_of(arm), 1e-7), 1);
    }
    expect_all(arm, planted, solutions, random, 20);
    EXPECT_LT(solutions.boxes, 3000U);
  }
}

/// One of the six moves another joint too, so that no turn brings both back.
struct Pair {
  std::size_t leader;
  bool leader_slides, follower_slides;
  double multiplier;
};

TEST(PosturesWhereNoTurnBringsAllBack, AreThoseInTheRanges) {
  RandomSource random(46);
  int complete = 0, rounds = 0;
  for (const Pair& pair : std::vector<Pair>{{0, false, true, 0.1},     // a screw
                                            {2, true, true, 1},        // a telescope
                                            {3, true, false, 1.25},    // a rack
                                            {1, false, false, 0.123},  // gears
                                            {4, false, false, -0.123}}) {
    Arm arm;
    do {
      arm = usual_arm(random, false);
      for (Joint& joint : arm) joint.xyz = random_vector(random);
      arm[pair.leader].turns = 0;
      arm[pair.leader].slides = pair.leader_slides;
      arm.insert(arm.begin() + std::ptrdiff_t(1 + random.below(6)),
                 {.xyz = random_vector(random),
                  .axis = random_axis(random, {0, 0, 1}),
                  .slides = pair.follower_slides,
                  .leader = pair.leader,
                  .multiplier = pair.multiplier,
                  .offset = 0.2});
    } while (std::fabs(determinant(arm, random_values(random, arm))) < 1e-3);
    const Numbers planted = random_values(random, arm);
    std::vector<std::string> at;
    for (std::size_t i = 0; i < 6; ++i) at.push_back(fmt::format("q{}={:.17g}", i + 1, planted[i]));
    const Solutions solutions = solved(text_of(arm, planted, kRange), at);
    ++rounds;
    if (!is_complete(solutions)) continue;
    ++complete;
    EXPECT_NE(solutions.how.find(fmt::format("of those with q{} in [", pair.leader + 1)),
              std::string::npos)
        << solutions.how;
    expect_all(arm, planted, solutions, random, 60);
    EXPECT_THAT([&] { (void)solved(text_of(arm, planted)); },
                testing::ThrowsMessage<UsageError>(
                    testing::HasSubstr("give each joint of the arm a range")));
  }
  EXPECT_EQ(complete, rounds);
}

/// A joint that is held holds what follows it.
TEST(AHeldJointOfAnArm, HoldsItsFollowers) {
  RandomSource random(47);
  Arm arm = usual_arm(random, true);
  arm.insert(arm.begin() + 4, {.xyz = {0.1, 0.2, 0}, .axis = {0, 0, 1}});
  arm.push_back(
      {.xyz = {0.1, 0, 0.2}, .axis = {0, 1, 0}, .leader = 3, .multiplier = 0.5, .offset = 0.3});
  arm.push_back({.xyz = {0.1, 0, 0.1}, .axis = {1, 0, 0}, .leader = 6, .multiplier = -1});
  const Numbers planted = random_values(random, arm);
  ModelOptions options;
  options.text = text_of(arm, planted);
  SearchOptions search;
  search.threads = 1;
  SolveRun run{search, {}};
  run.held = {"q4"};
  const Solutions solutions = solve(read_solve_request(options, {}), run);
  ASSERT_TRUE(is_complete(solutions)) << solutions.obstacle;
  const auto with_held = [&](Numbers q) {
    q.insert(q.begin() + 3, planted[3]);
    return q;
  };
  const Gap gap{arm, end_of(arm, planted)};
  Numbers six = planted;
  six.erase(six.begin() + 3);
  const Numbers periods(6, 2 * std::numbers::pi);
  EXPECT_EQ(count_near(solutions, six, periods, 1e-7), 1);
  for (const CertainSolution& s : solutions.found)
    EXPECT_TRUE(gap.is_posture(with_held(middle_of(s.values))));
}

/// With tolerances each posture is in its tube whatever the lengths are.
TEST(TubesOfAnArmWithFollowers, HaveThePosturesOfOtherLengths) {
  RandomSource random(48);
  const Arm arm = usual_arm(random, true);
  const Numbers planted = random_values(random, arm);
  const std::string tolerance = "length_tolerance = 1e-5\n";
  std::string text = text_of(arm, planted);
  text.insert(text.find("joints ="), tolerance);
  const Solutions tubes = solved(text), points = solved(text_of(arm, planted));
  ASSERT_TRUE(is_complete(tubes)) << tubes.obstacle;
  ASSERT_EQ(tubes.found.size(), points.found.size());
  for (int other = 0; other < 20; ++other) {
    Arm moved = arm;
    for (Joint& joint : moved)
      for (double& x : joint.xyz)
        if (x != 0) x += random.between(-1e-5, 1e-5);
    const Gap gap{moved, end_of(arm, planted)};
    for (const CertainSolution& point : points.found) {
      const Numbers q = newton(gap, middle_of(point.values));
      ASSERT_FALSE(q.empty());
      EXPECT_EQ(
          std::ranges::count_if(
              tubes.found, [&](const CertainSolution& tube) { return is_within(q, tube.values); }),
          1);
    }
  }
}

}  // namespace
}  // namespace regulus::detail::test::coupled_arms
