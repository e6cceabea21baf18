// SPDX-License-Identifier: GPL-3.0-or-later
// Lists whose solutions move so far within the tolerances that one test does not show them: they are
// followed. The oracles are Newton's method in doubles along a segment of robots, and numbers of poses
// on a grid of angles.
#include <fmt/format.h>

#include "tests/property/solve/planar_platform.hpp"
#include "tests/property/solve/tubes.hpp"
#include "tests/support/random_source.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::followed_lists_test {
namespace {

std::string six_poses(const std::string& tolerance) {
  return replaced(library_model("rpr_6"), "[legs]", "[legs]\nbase_tolerance = " + tolerance);
}

/// Follows a solution to a robot by small steps; `robot_at` takes 0 to 1. Empty: it is lost.
template <class RobotAt>
Numbers followed(const RobotAt& robot_at, Numbers x) {
  constexpr int kSteps = 32;
  for (int step = 1; step <= kSteps && !x.empty(); ++step)
    x = newton(robot_at(double(step) / kSteps), x);
  return x;
}

std::vector<Numbers> starts_of(const std::string& certificate) {
  std::vector<Numbers> starts;
  for (const std::string& line : lines_of(certificate)) {
    if (!line.starts_with("from ")) continue;
    std::istringstream words(line.substr(5));
    starts.emplace_back();
    for (double x; words >> x;) starts.back().push_back(x);
  }
  return starts;
}

TEST(FollowedPoses, StayInTheirTubes) {
  constexpr double kTolerance = 0.1;
  const Certified made = certified(six_poses("0.1"));
  ASSERT_EQ(made.solutions.completeness, Completeness::kComplete) << made.solutions.obstacle;
  const auto tubes = tubes_of(made.text);
  const auto starts = starts_of(made.text);
  ASSERT_EQ(tubes.size(), 6U);
  ASSERT_EQ(starts.size(), 6U);
  RandomSource random(4);
  for (int round = 0; round < 20; ++round) {
    std::array<std::array<double, 2>, 3> moved{};
    for (auto& anchor : moved)
      for (double& x : anchor)
        x = round % 2 == 0 ? random.between(-kTolerance, kTolerance)
                           : std::copysign(kTolerance, random.between(-1, 1));
    const auto robot_at = [&](double part) {
      PlanarRobot robot;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 2; ++k) robot.a[i][k] += part * moved[i][k];
      return robot;
    };
    for (std::size_t k = 0; k < tubes.size(); ++k) {
      const Numbers pose = followed(robot_at, starts[k]);
      ASSERT_EQ(pose.size(), 3U);
      EXPECT_TRUE(is_within(pose, tubes[k])) << k;
    }
  }
}

TEST(FollowedPoses, AreVerifiedAndForgeriesAreNot) {
  const std::string model = six_poses("0.1");
  const Certified made = certified(model);
  const verifier::Verification v = verified(made.text, model);
  ASSERT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(v.roots, 6U);
  const std::string plain = without_sum(made.text);
  EXPECT_EQ(outcome(plain, six_poses("0.11")), Outcome::kRejected);

  Lines fewer = lines_of(made.text);
  fewer.erase(fewer.begin() + std::ptrdiff_t(first(fewer, "solution")));
  const std::string five = replaced(joined(fewer), "exactly 6", "exactly 5");
  EXPECT_EQ(outcome(five), Outcome::kRejected);
  fewer.erase(fewer.begin() + std::ptrdiff_t(first(fewer, "from")));
  EXPECT_EQ(outcome(replaced(joined(fewer), "exactly 6", "exactly 5")), Outcome::kRejected);

  Lines swapped = lines_of(made.text);
  const std::size_t from = first(swapped, "from");
  std::swap(swapped[from], swapped[from + 1]);
  EXPECT_EQ(outcome(joined(swapped)), Outcome::kRejected);
  Lines other = lines_of(made.text);
  other[from] = other[from + 1];
  EXPECT_NE(outcome(joined(other)), Outcome::kVerified);

  // It is true that there are at least so many.
  Lines certain = lines_of(plain);
  certain[first(certain, "verdict")] = "verdict INCOMPLETE";
  EXPECT_EQ(outcome(replaced(joined(certain), "exactly 6", "at least 6")), Outcome::kVerified);

  Lines narrow = lines_of(made.text);
  std::string& line = narrow[first(narrow, "solution")];
  const std::vector<Interval> tube = tubes_of(made.text).front();
  line = "solution";
  for (const Interval& x : tube)
    line += fmt::format(" {:a}:{:a}", mid(x) - rad_ru(x) / 4, mid(x) + rad_ru(x) / 4);
  EXPECT_NE(outcome(joined(narrow)), Outcome::kVerified);

  // Within 0.2 two poses meet.
  std::string wider = plain;
  for (std::size_t at = wider.find("+- 1/10\n"); at != std::string::npos;
       at = wider.find("+- 1/10\n", at))
    wider.replace(at, 7, "+- 1/5");
  ASSERT_NE(wider, plain);
  EXPECT_NE(outcome(wider), Outcome::kVerified);
}

TEST(FollowedPoses, ThatMeetAreNotAll) {
  const Certified made = certified(six_poses("0.2"));
  EXPECT_EQ(made.solutions.completeness, Completeness::kIncomplete);
  EXPECT_EQ(made.solutions.found.size(), 4U);
  EXPECT_TRUE(made.solutions.changes);
  EXPECT_EQ(made.solutions.obstacle,
            "there are 6 with all that is uncertain in the middle of its range, and 4 with a1_x = "
            "0.2, a1_y = 0.2, a2_x = 15.71, a2_y = 0.2, a3_x = 0.2, a3_y = 9.8");
  const PlanarRobot nominal;
  PlanarPlatform robot{nominal.a, nominal.b, nominal.length};
  EXPECT_EQ(robot.count(), 6);
  robot.base = {{{0.2, 0.2}, {15.71, 0.2}, {0.2, 9.8}}};
  EXPECT_EQ(robot.count(), 4);
}

TEST(FollowedPoses, ThatAreNotAllAreVerifiedEachByItself) {
  const std::string model = six_poses("0.2");
  const Certified made = certified(model);
  const verifier::Verification v = verified(made.text, model);
  ASSERT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(v.roots, 4U);
  const auto tubes = tubes_of(made.text);
  const std::string plain = without_sum(made.text);
  EXPECT_EQ(outcome(plain, six_poses("0.21")), Outcome::kRejected);
  for (std::size_t k = 0; k < tubes.front().size(); ++k)
    for (const bool is_lower : {true, false}) {
      Lines lines = lines_of(plain);
      std::string& line = lines[first(lines, "solution")];
      line = "solution";
      for (std::size_t i = 0; i < tubes.front().size(); ++i) {
        const Interval& x = tubes.front()[i];
        const double middle = mid(x);
        line += fmt::format(" {:a}:{:a}", i == k && !is_lower ? middle : x.lo,
                            i == k && is_lower ? middle : x.hi);
      }
      EXPECT_NE(outcome(joined(lines)), Outcome::kVerified) << k;
    }
  // A line about two of the poses that may meet.
  Lines lines = lines_of(plain);
  lines[first(lines, "solution")] = "solution -18:-12 -9:3 -0.1:0.9";
  EXPECT_NE(outcome(joined(lines)), Outcome::kVerified);
}

/// Where a list is complete, each robot of the set has as many poses; where their number is said to
/// change, it does.
TEST(FollowedPosesOfRandomPlatforms, HaveTheSameNumberEverywhere) {
  constexpr int kGrid = 20'000;
  RandomSource random(11);
  int followed = 0, changed = 0;
  for (int round = 0; round < trials(40, 400); ++round) {
    PlanarPlatform robot{};
    std::string legs;
    for (std::size_t i = 0; i < 3; ++i) {
      for (auto* anchor : {&robot.base[i], &robot.platform[i]})
        for (double& x : *anchor) x = std::round(random.between(-1e3, 1e3)) / 100;
      legs += fmt::format("[[legs.leg]]\nbase = [{}, {}]\nplatform = [{}, {}]\n", robot.base[i][0],
                          robot.base[i][1], robot.platform[i][0], robot.platform[i][1]);
    }
    const double tolerance = std::round(random.between(1, 30)) / 100;
    for (double& length : robot.legs) length = std::round(random.between(300, 1500)) / 100;
    const std::string model = fmt::format(
        "regulus = 1\nname = \"planar\"\n[legs]\ntype = \"RPR\"\nbase_tolerance = {}\n{}"
        "[motion.m]\nlegs = [{}, {}, {}]\n",
        tolerance, legs, robot.legs[0], robot.legs[1], robot.legs[2]);
    const Certified made = certified(model, {}, "", 40'000);
    const Solutions& solutions = made.solutions;
    const bool is_followed = !starts_of(made.text).empty();
    changed += solutions.changes;
    if (!is_complete(solutions)) continue;
    followed += is_followed;
    if (is_followed) {
      const verifier::Verification v = verified(made.text, model);
      EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v) << model;
    }
    for (int corner = 0; corner < 8; ++corner) {
      PlanarPlatform other = robot;
      for (auto& anchor : other.base)
        for (double& x : anchor) x += std::copysign(tolerance, random.between(-1, 1));
      const int count = other.count(kGrid);
      if (count < 0) continue;
      EXPECT_EQ(count, int(solutions.found.size())) << model;
    }
  }
  EXPECT_GE(followed, 3);
  EXPECT_GE(changed, 3);
}

/// DATA of the published case: how far the configuration moves if each leg is wrong by up to 0.2.
TEST(FollowedConfigurations, ReachThePublishedErrors) {
  const Certified made = certified(library_model("alias_3rpr"), {}, "middle");
  ASSERT_EQ(made.solutions.completeness, Completeness::kComplete) << made.solutions.obstacle;
  ASSERT_EQ(made.solutions.found.size(), 2U);
  EXPECT_EQ(verified(made.text, library_model("alias_3rpr")).outcome, Outcome::kVerified);
  constexpr std::array<double, 3> kAt = {5, 5, 0}, kMost = {0.93150, 1.03156, 0.44133};
  const std::vector<Interval>& tube = made.solutions.found.back().values;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GE(mag(tube[i] - Interval(kAt[i])), kMost[i]);
    EXPECT_LE(mag(tube[i] - Interval(kAt[i])), 1.1 * kMost[i]);
  }
}

/// x = 5, and x = ±√t where t > 0: two solutions are born within the line of the first, at other values than
/// the middle. All is within the line, but not regular.
TEST(FollowedConfigurations, AreNotProvedWhereTwoAreBornWithinALine) {
  const auto fold = [](const char* tolerance) {
    return fmt::format(
        "regulus = 1\nname = \"fold\"\n[pose]\ns = \"1\"\n[geometry]\n"
        "t = {{ value = \"-2/5\", tolerance = \"{}\", group = \"t\" }}\n[closure]\n"
        "unknowns = {{ x = \"1\" }}\nequations = [\"(x - 5)*(x^2 - t) + 0*s\"]\n"
        "start = {{ s = 0, x = 5 }}\nrange = {{ x = [-10, 10] }}\n[motion.only]\ns = 0\n",
        tolerance);
  };
  const Certified made = certified(fold("3/10"));
  ASSERT_EQ(made.solutions.found.size(), 1U);
  Lines lines = lines_of(replaced(without_sum(made.text), "proof\n", "proof\nfrom 5\n"));
  lines[first(lines, "solution")] = "solution -4:9";
  EXPECT_EQ(outcome(joined(lines)), Outcome::kVerified);
  EXPECT_NE(outcome(replaced(joined(lines), "+- 3/10", "+- 3/5")), Outcome::kVerified);
  // Nor does a list that need not be whole say that one is within the line.
  lines[first(lines, "verdict")] = "verdict INCOMPLETE";
  const std::string some = replaced(joined(lines), "exactly 1", "at least 1");
  EXPECT_EQ(outcome(some), Outcome::kVerified);
  EXPECT_NE(outcome(replaced(some, "+- 3/10", "+- 3/5")), Outcome::kVerified);
  EXPECT_EQ(certified(fold("3/5")).solutions.completeness, Completeness::kIncomplete);
}

/// In space a pose moves by centimetres while the anchors move by hundredths of a millimetre.
TEST(FollowedPosesInSpace, AreVerifiedAndForgeriesAreNot) {
  const std::string whole = library_model("robot_1");
  const std::string model =
      replaced(whole.substr(0, whole.find("[motion.")), "[gough]",
               "[gough]\nbase_tolerance = 0.001") +
      "[motion.at]\nx = 1\ny = 2\nz = 47\npsi = 0.1\ntheta = 0.12\nphi = 0.05\n";
  const Certified made = certified(model, {}, "", 100'000);
  ASSERT_EQ(made.solutions.completeness, Completeness::kComplete) << made.solutions.obstacle;
  ASSERT_EQ(starts_of(made.text).size(), 12U);
  const verifier::Verification v = verified(made.text, model);
  ASSERT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  Lines fewer = lines_of(made.text);
  fewer.erase(fewer.begin() + std::ptrdiff_t(first(fewer, "solution")));
  fewer.erase(fewer.begin() + std::ptrdiff_t(first(fewer, "from")));
  EXPECT_EQ(outcome(replaced(joined(fewer), "exactly 12", "exactly 11")), Outcome::kRejected);
  Lines swapped = lines_of(made.text);
  const std::size_t from = first(swapped, "from");
  std::swap(swapped[from], swapped[from + 1]);
  EXPECT_EQ(outcome(joined(swapped)), Outcome::kRejected);
}

}  // namespace
}  // namespace regulus::detail::test::followed_lists_test
