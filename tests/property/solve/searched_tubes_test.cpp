// SPDX-License-Identifier: GPL-3.0-or-later
// Lists with tolerances that are searched: poses of a platform with fewer than 40 complex ones, and postures.
// The oracles are Newton's method in doubles on robots at corners of the set, and closed forms of where two
// postures meet.
#include <fmt/format.h>

#include <array>
#include <numbers>

#include "tests/property/solve/tubes.hpp"
#include "tests/support/random_source.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::searched_tubes_test {
namespace {

/// More than other lists.
constexpr std::uint64_t kBoxes = 100'000;

double side(RandomSource& random, double size) { return random.between(-1, 1) < 0 ? -size : size; }

// Six legs.

constexpr std::array<double, 6> kLengths = {47.5, 48.25, 48.125, 47.75, 47.25, 47.875};

/// Robot 1 of the library, at lengths of its legs.
std::string robot_1(const std::string& tolerance, const std::string& error) {
  const std::string whole = library_model("robot_1");
  return replaced(
             whole.substr(0, whole.find("[motion.")), "[gough]",
             fmt::format("[gough]\nbase_tolerance = {0}\nplatform_tolerance = {0}", tolerance)) +
         fmt::format("[motion.legs]\nlegs = [{}]\nerror = {{ legs = {} }}\n",
                     fmt::join(kLengths, ", "), error);
}

SpatialRobot robot_1() {
  return {{{{-9, 9, 0}, {9, 9, 0}, {12, -3, 0}, {3, -13, 0}, {-3, -13, 0}, {-12, -3, 0}}},
          {{{-3, 7, 0}, {3, 7, 0}, {7, -1, 0}, {4, -6, 0}, {-4, -6, 0}, {-7, -1, 0}}},
          kLengths};
}

TEST(SearchedPosesWithTolerances, HaveAPoseInEachTubeAtEachCorner) {
  constexpr double kSize = 3e-5;
  const Certified made = certified(robot_1("3e-5", "3e-5"), {}, "", kBoxes);
  ASSERT_TRUE(made.status.is_written()) << made.status.obstacle();
  ASSERT_EQ(made.solutions.completeness, Completeness::kComplete) << made.solutions.obstacle;
  ASSERT_FALSE(made.solutions.is_counted);
  const auto tubes = tubes_of(made.text);
  ASSERT_GE(tubes.size(), 2U);
  RandomSource random(5);
  for (int round = 0; round < trials(3, 8); ++round) {
    SpatialRobot robot = robot_1();
    for (auto* anchors : {&robot.a, &robot.b})
      for (auto& anchor : *anchors)
        for (double& x : anchor) x += side(random, kSize);
    for (double& length : robot.length) length += side(random, kSize);
    for (const auto& tube : tubes) {
      const Numbers pose = newton(robot, middle_of(tube));
      ASSERT_EQ(pose.size(), 7U);
      EXPECT_TRUE(is_within(pose, tube));
    }
  }
}

TEST(SearchedPosesWithTolerances, AreVerifiedWithTheirFileAndForgeriesAreNot) {
  const std::string model = robot_1("3e-5", "3e-5");
  const Certified made = certified(model, {}, "", kBoxes);
  EXPECT_EQ(made.status.line().find("may not finish"), std::string::npos) << made.status.line();
  const verifier::Verification v = verified(made.text, model);
  ASSERT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  const std::string plain = without_sum(made.text);
  EXPECT_EQ(outcome(plain, robot_1("4e-5", "3e-5")), Outcome::kRejected);
  EXPECT_EQ(outcome(plain, robot_1("3e-5", "4e-5")), Outcome::kRejected);
  EXPECT_EQ(outcome(plain, robot_1("3e-5", "2e-5")), Outcome::kVerified);
  const std::size_t count = made.solutions.found.size();
  Lines fewer = lines_of(made.text);
  fewer.erase(fewer.begin() + std::ptrdiff_t(first(fewer, "solution")));
  EXPECT_EQ(outcome(replaced(joined(fewer), fmt::format("exactly {}", count),
                             fmt::format("exactly {}", count - 1))),
            Outcome::kRejected);
  Lines twice = lines_of(made.text);
  const std::size_t at = first(twice, "solution");
  twice.insert(twice.begin() + std::ptrdiff_t(at), twice[at]);
  EXPECT_NE(outcome(replaced(joined(twice), fmt::format("exactly {}", count),
                             fmt::format("exactly {}", count + 1))),
            Outcome::kVerified);
  // A wider set than that in which the poses stay apart.
  std::string wider = plain;
  for (std::size_t i = wider.find("+- 3/100000\n"); i != std::string::npos;
       i = wider.find("+- 3/100000\n", i))
    wider.replace(i, 11, "+- 1/10");
  ASSERT_NE(wider, plain);
  EXPECT_NE(outcome(wider), Outcome::kVerified);
}

// Arms.

/// The PUMA 560 of the library, its tool at a place.
std::string puma(const std::string& tolerance) {
  const std::string whole = library_model("puma_560_serial");
  std::string arm = whole.substr(0, whole.find("[motion."));
  for (std::size_t at = arm.find("tolerance = 0"); at != std::string::npos;
       at = arm.find("tolerance = 0,", at + 1))
    arm.replace(at, 13, "tolerance = " + tolerance);
  return arm + "[motion.tool]\ntool = [0.4, 0.1, 0.5, 0, 0.2, 1]\n";
}

using Matrix4 = std::array<std::array<double, 4>, 4>;

Matrix4 product(const Matrix4& A, const Matrix4& B) {
  Matrix4 C{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k) C[i][j] += A[i][k] * B[k][j];
  return C;
}

Matrix4 turn(std::size_t axis, double angle) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  Matrix4 T{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  T[u][u] = T[v][v] = std::cos(angle);
  T[u][v] = -std::sin(angle), T[v][u] = std::sin(angle);
  return T;
}

Matrix4 shift(double x, double z) {
  return {{{1, 0, 0, x}, {0, 1, 0, 0}, {0, 0, 1, z}, {0, 0, 0, 1}}};
}

/// By modified Denavit-Hartenberg rows: its six equations at a place.
struct Puma {
  double a2 = 0.4318, a3 = -0.0203, d2 = 0.2435, d3 = -0.0934, d4 = 0.4331;
  Matrix4 place{};

  [[nodiscard]] Matrix4 end(const Numbers& q) const {
    constexpr double kQuarter = std::numbers::pi / 2;
    const double alpha[6] = {0, -kQuarter, 0, kQuarter, -kQuarter, kQuarter},
                 a[6] = {0, 0, a2, a3, 0, 0}, d[6] = {0, d2, d3, d4, 0, 0};
    Matrix4 T = shift(0, 0);
    for (std::size_t i = 0; i < 6; ++i) {
      T = product(T, product(turn(0, alpha[i]), shift(a[i], 0)));
      T = product(T, product(turn(2, q[i]), shift(0, d[i])));
    }
    return T;
  }

  Numbers operator()(const Numbers& q) const {
    const Matrix4 T = end(q);
    Matrix4 E{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) E[i][j] += T[i][k] * place[j][k];
    Numbers value;
    for (std::size_t i = 0; i < 3; ++i) value.push_back(T[i][3] - place[i][3]);
    for (std::size_t i = 0; i < 3; ++i)
      value.push_back(E[(i + 2) % 3][(i + 1) % 3] - E[(i + 1) % 3][(i + 2) % 3]);
    return value;
  }
};

Matrix4 place_of_tool() {
  Matrix4 T = product(turn(2, 1.0), product(turn(1, 0.2), turn(0, 0.0)));
  T[0][3] = 0.4, T[1][3] = 0.1, T[2][3] = 0.5;
  return T;
}

TEST(PosturesWithTolerances, HaveAPostureInEachTubeAtEachCorner) {
  constexpr double kSize = 1e-4;
  const Certified made = certified(puma("1e-4"), {}, "tool");
  ASSERT_EQ(made.solutions.completeness, Completeness::kComplete) << made.solutions.obstacle;
  EXPECT_FALSE(made.solutions.is_nominal);
  ASSERT_TRUE(made.status.is_written()) << made.status.obstacle();
  const auto tubes = tubes_of(made.text);
  ASSERT_EQ(tubes.size(), 8U);
  RandomSource random(6);
  for (int round = 0; round < trials(7, 20); ++round) {
    Puma arm;
    arm.place = place_of_tool();
    for (double* length : {&arm.a2, &arm.a3, &arm.d2, &arm.d3, &arm.d4})
      *length += side(random, kSize);
    for (const auto& tube : tubes) {
      const Numbers posture = newton(arm, middle_of(tube));
      ASSERT_EQ(posture.size(), 6U);
      EXPECT_TRUE(is_within(posture, tube));
    }
  }
}

TEST(PosturesWithTolerances, AreVerifiedWithTheirFileAndForgeriesAreNot) {
  const std::string model = puma("1e-4");
  const Certified made = certified(model, {}, "tool");
  const verifier::Verification v = verified(made.text, model);
  ASSERT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(v.claim,
            "at every value of the 5 uncertain quantities, an arm of these six joints whose end is "
            "at this place has exactly 8 postures, one within each line 'solution'");
  const std::string plain = without_sum(made.text);
  EXPECT_EQ(outcome(plain, puma("2e-4")), Outcome::kRejected);
  EXPECT_NE(outcome(plain, puma("0")), Outcome::kVerified);
  EXPECT_NE(outcome(without_sum(certified(puma("0"), {}, "tool").text), model), Outcome::kVerified);
  Lines fewer = lines_of(made.text);
  fewer.erase(fewer.begin() + std::ptrdiff_t(first(fewer, "solution")));
  EXPECT_EQ(outcome(replaced(joined(fewer), "exactly 8", "exactly 7")), Outcome::kRejected);
  Lines narrow = lines_of(made.text);
  std::string& line = narrow[first(narrow, "solution")];
  const std::size_t colon = line.find(':'), end = line.find(' ', colon);
  line = line.substr(0, colon + 1) + line.substr(9, colon - 9) + line.substr(end);
  EXPECT_NE(outcome(joined(narrow)), Outcome::kVerified);
  std::string wider = plain;
  for (std::size_t at = wider.find("+- 1/10000\n"); at != std::string::npos;
       at = wider.find("+- 1/10000\n", at))
    wider.replace(at, 10, "+- 1/4");
  ASSERT_NE(wider, plain);
  EXPECT_NE(outcome(wider), Outcome::kVerified);
}

/// The place that joints give is that of the nominal arm: the arm in the file need not have it there.
TEST(PosturesWithTolerances, AreAtThePlaceOfTheNominalArm) {
  const std::string model =
      replaced(puma("1e-4"), "[motion.tool]\ntool = [0.4, 0.1, 0.5, 0, 0.2, 1]",
               "[motion.at]\nq1 = 0.3\nq2 = 0.4\nq3 = -0.7\nq4 = 0.3\nq5 = 0.9\nq6 = -1.4");
  const Certified made = certified(model);
  ASSERT_EQ(made.solutions.completeness, Completeness::kComplete) << made.solutions.obstacle;
  const verifier::Verification v = verified(made.text, model);
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  const auto tubes = tubes_of(made.text);
  RandomSource random(7);
  const Matrix4 place = Puma{}.end({0.3, 0.4, -0.7, 0.3, 0.9, -1.4});
  for (int round = 0; round < trials(4, 10); ++round) {
    Puma arm;
    arm.place = place;
    for (double* length : {&arm.a2, &arm.a3, &arm.d2, &arm.d3, &arm.d4})
      *length += side(random, 1e-4);
    for (const auto& tube : tubes) {
      const Numbers posture = newton(arm, middle_of(tube));
      ASSERT_EQ(posture.size(), 6U);
      EXPECT_TRUE(is_within(posture, tube));
    }
  }
}

/// Two links of 0.4 m that may be longer or shorter, and a wrist at the distance r: the elbow has two sides where
/// r is less than their sum. `bend`: of the nominal elbow.
Certified with_elbow(double bend, double tolerance, std::uint64_t boxes) {
  return certified(fmt::format(R"toml(regulus = 1
name = "elbow"
[geometry]
a = {{ value = 0.4, tolerance = {0:.17g}, group = "links" }}
b = {{ value = 0.4, tolerance = {0:.17g}, group = "links" }}
[serial]
unit = "m"
convention = "modified-dh"
joints = [
  {{ name = "q1" }},
  {{ name = "q2", alpha = "-90*deg" }},
  {{ name = "q3", a = "a" }},
  {{ name = "q4", alpha = "90*deg", d = "b" }},
  {{ name = "q5", alpha = "-90*deg" }},
  {{ name = "q6", alpha = "90*deg" }},
]
[motion.at]
q1 = 0.3
q2 = 0.4
q3 = {1:.17g}
q4 = 0.5
q5 = 0.9
q6 = 0.2
)toml",
                               tolerance, bend + std::numbers::pi / 2),
                   {}, "", boxes);
}

/// With the elbow bent by β the wrist is at 0.8·cos(β/2), and the shortest links reach 0.8 − 2e.
TEST(PosturesThatMeetWithinTolerances, AreNeverAll) {
  for (const double bend : {0.05, 0.2}) {
    const double meeting = 0.4 * (1 - std::cos(bend / 2));
    for (const double part : {1.02, 3.0}) {
      const Certified made = with_elbow(bend, part * meeting, 3'000);
      EXPECT_EQ(made.solutions.completeness, Completeness::kIncomplete) << bend << ' ' << part;
      EXPECT_NE(made.solutions.obstacle, "");
    }
    const Certified apart = with_elbow(bend, meeting / 64, kBoxes);
    EXPECT_EQ(apart.solutions.completeness, Completeness::kComplete) << apart.solutions.obstacle;
    EXPECT_EQ(apart.solutions.found.size(), 8U);
    EXPECT_EQ(outcome(apart.text), Outcome::kVerified);
  }
}

}  // namespace
}  // namespace regulus::detail::test::searched_tubes_test
