// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of lists of poses whose anchors and lengths have tolerances and errors. The oracle is Newton's
// method in doubles, on platforms at corners of the set.
#include <fmt/format.h>

#include "tests/property/solve/tubes.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test::tolerance_certificates_test {
namespace {

std::string planar(const std::string& base_tolerance, const std::string& error) {
  return replaced(
      replaced(library_model("rpr_6"), "[legs]", "[legs]\nbase_tolerance = " + base_tolerance),
      "[motion.legs]", "[motion.legs]\nerror = { legs = " + error + " }");
}

TEST(PlanarListsWithTolerances, HaveAPoseInEachTubeAtEachCorner) {
  constexpr double kTolerance = 0.002, kError = 0.001;
  const Certified made = certified(planar("0.002", "0.001"));
  ASSERT_TRUE(made.status.is_written()) << made.status.obstacle();
  EXPECT_EQ(made.solutions.completeness, Completeness::kComplete);
  EXPECT_FALSE(made.solutions.is_nominal);
  const auto tubes = tubes_of(made.text);
  ASSERT_EQ(tubes.size(), 6U);
  RandomSource random(3);
  const auto side = [&](double size) { return random.between(-1, 1) < 0 ? -size : size; };
  for (int round = 0; round < 20; ++round) {
    PlanarRobot robot;
    for (auto& anchor : robot.a)
      for (double& x : anchor) x += side(kTolerance);
    for (double& length : robot.length) length += side(kError);
    for (const auto& tube : tubes) {
      const Numbers pose = newton(robot, middle_of(tube));
      ASSERT_EQ(pose.size(), 3U);
      EXPECT_TRUE(is_within(pose, tube));
    }
  }
}

TEST(PlanarListsWithTolerances, AreVerifiedWithTheirFile) {
  const std::string model = planar("0.002", "0.001");
  const Certified made = certified(model);
  const verifier::Verification v = verified(made.text, model);
  ASSERT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(
      v.claim,
      "at every value of the 9 uncertain quantities, a platform on three legs in the plane with "
      "these anchors and lengths has exactly 6 poses, one within each line 'solution'");
  const std::string plain = without_sum(made.text);
  EXPECT_EQ(outcome(plain, planar("0.003", "0.001")), Outcome::kRejected);
  EXPECT_EQ(outcome(plain, planar("0.002", "0.0011")), Outcome::kRejected);
  EXPECT_EQ(outcome(plain, planar("0.002", "0.0009")), Outcome::kVerified);
  EXPECT_EQ(outcome(plain, replaced(model, "[legs]", "[legs]\nplatform_tolerance = 0.001")),
            Outcome::kRejected);
  EXPECT_EQ(outcome(plain, replaced(model, "[legs]", "[legs]\ntolerance_shape = \"ball\"")),
            Outcome::kRejected);
  EXPECT_EQ(outcome(without_sum(certified(library_model("rpr_6")).text), model),
            Outcome::kUnfinished);
}

/// Dietmaier's platform with other lengths.
std::string other_lengths() {
  return replaced(library_model("dietmaier"), "1, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071",
                  "1.0729, 1.1026, 1.4031, 1.7041, 2.679, 1.4815");
}

std::string in_space(const std::string& base_tolerance, const std::string& error) {
  return replaced(
      replaced(other_lengths(), "[gough]",
               "[gough]\nplatform_tolerance = 1e-8\nbase_tolerance = " + base_tolerance),
      "[motion.legs]", "[motion.legs]\nerror = { legs = " + error + " }");
}

/// Dietmaier's platform with those lengths.
SpatialRobot dietmaier() {
  return {{{{0, 0, 0},
            {1.107915, 0, 0},
            {0.549094, 0.756063, 0},
            {0.735077, -0.223935, 0.525991},
            {0.514188, -0.526063, -0.368418},
            {0.590473, 0.094733, -0.205018}}},
          {{{0, 0, 0},
            {0.542805, 0, 0},
            {0.956919, -0.528915, 0},
            {0.665885, -0.353482, 1.402538},
            {0.478359, 1.158742, 0.107672},
            {-0.137087, -0.235121, 0.353913}}},
          {1.0729, 1.1026, 1.4031, 1.7041, 2.679, 1.4815}};
}

TEST(ListsWithTolerancesInSpace, HaveAPoseInEachTubeAtEachCorner) {
  const std::string model = in_space("1e-8", "1e-8");
  const Certified made = certified(model);
  ASSERT_TRUE(made.status.is_written()) << made.status.obstacle();
  const auto tubes = tubes_of(made.text);
  ASSERT_GE(tubes.size(), 2U);
  RandomSource random(4);
  const auto side = [&](double size) { return random.between(-1, 1) < 0 ? -size : size; };
  for (int round = 0; round < 5; ++round) {
    SpatialRobot robot = dietmaier();
    for (auto* anchors : {&robot.a, &robot.b})
      for (auto& anchor : *anchors)
        for (double& x : anchor) x += side(1e-8);
    for (double& length : robot.length) length += side(1e-8);
    for (const auto& tube : tubes) {
      const Numbers pose = newton(robot, middle_of(tube));
      ASSERT_EQ(pose.size(), 7U);
      EXPECT_TRUE(is_within(pose, tube));
    }
  }
}

TEST(ListsWithTolerancesInSpace, AreVerifiedWithTheirFileAndForgeriesAreNot) {
  const std::string model = in_space("1e-8", "1e-8");
  const Certified made = certified(model);
  const verifier::Verification v = verified(made.text, model);
  ASSERT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(v.roots, 40U);
  EXPECT_EQ(made.solutions.completeness, Completeness::kComplete);
  const std::string plain = without_sum(made.text);
  EXPECT_EQ(outcome(plain, in_space("2e-8", "1e-8")), Outcome::kRejected);
  EXPECT_EQ(outcome(plain, in_space("1e-8", "2e-8")), Outcome::kRejected);
  EXPECT_EQ(outcome(plain, other_lengths()), Outcome::kRejected);
  const Lines genuine = lines_of(made.text);
  Lines fewer = genuine;
  fewer.erase(fewer.begin() + std::ptrdiff_t(first(fewer, "solution")));
  const std::string claim = joined(fewer);
  const std::size_t count = made.solutions.found.size();
  EXPECT_EQ(outcome(replaced(claim, fmt::format("exactly {}", count),
                             fmt::format("exactly {}", count - 1))),
            Outcome::kRejected);
  // The tube of one pose is narrower than where it can be.
  Lines narrow = genuine;
  std::string& line = narrow[first(narrow, "solution")];
  const std::size_t colon = line.find(':'), end = line.find(' ', colon);
  line = line.substr(0, colon + 1) + line.substr(9, colon - 9) + line.substr(end);
  EXPECT_NE(outcome(joined(narrow)), Outcome::kVerified);
  // A wider set than that in which the poses stay apart.
  EXPECT_NE(outcome(replaced(plain, "+- 1/100000000\n", "+- 1/10\n")), Outcome::kVerified);
}

}  // namespace
}  // namespace regulus::detail::test::tolerance_certificates_test
