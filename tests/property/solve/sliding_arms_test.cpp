// SPDX-License-Identifier: GPL-3.0-or-later
// All postures of arms with joints that slide. The oracles are forward kinematics in doubles, Newton's
// method from many starts, and closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/property/solve/tubes.hpp"
#include "tests/support/random_source.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::sliding_arms_test {
namespace {

struct DhJoint {
  double a = 0, alpha = 0, d = 0, theta = 0;  ///< d and theta: of the value that the joint has not
  bool slides = false;
};
using Arm = std::array<DhJoint, 6>;
using Matrix4 = std::array<std::array<double, 4>, 4>;

/// Rz·Tz·Tx·Rx of each joint.
Matrix4 end_of(const Arm& arm, const Numbers& q) {
  Matrix4 T{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  for (std::size_t i = 0; i < 6; ++i) {
    const double theta = arm[i].slides ? arm[i].theta : q[i], d = arm[i].slides ? q[i] : arm[i].d;
    const double c = std::cos(theta), s = std::sin(theta);
    const double ca = std::cos(arm[i].alpha), sa = std::sin(arm[i].alpha);
    const Matrix4 link{{{c, -s * ca, s * sa, arm[i].a * c},
                        {s, c * ca, -c * sa, arm[i].a * s},
                        {0, sa, ca, d},
                        {0, 0, 0, 1}}};
    Matrix4 next{};
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t m = 0; m < 4; ++m) next[r][k] += T[r][m] * link[m][k];
    T = next;
  }
  return T;
}

/// `range`: of each joint; 0: none is given.
std::string text_of(const Arm& arm, const Numbers& q, double range = 0) {
  std::string joints, motion;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string value =
        arm[i].slides ? fmt::format("type = \"prismatic\", theta = {:.17g}", arm[i].theta)
                      : fmt::format("d = {:.17g}", arm[i].d);
    joints += fmt::format("{{ name = \"q{}\", a = {:.17g}, alpha = {:.17g}, {}{} }},\n", i + 1,
                          arm[i].a, arm[i].alpha, value,
                          range > 0 ? fmt::format(", range = [{}, {}]", -range, range) : "");
    motion += fmt::format("q{} = {:.17g}\n", i + 1, q[i]);
  }
  return fmt::format(
      "regulus = 1\nname = \"arm\"\n[serial]\nconvention = \"standard-dh\"\njoints = [\n{}]\n"
      "[motion.at]\n{}",
      joints, motion);
}

/// The gap between the ends, and half of E − Eᵀ for the rotation E from one to the other.
struct Gap {
  const Arm& arm;
  const Matrix4 end;

  Numbers operator()(const Numbers& q) const {
    const Matrix4 T = end_of(arm, q);
    double E[3][3] = {};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) E[i][j] += T[i][k] * end[j][k];
    return {T[0][3] - end[0][3], T[1][3] - end[1][3], T[2][3] - end[2][3],
            E[2][1] - E[1][2],   E[0][2] - E[2][0],   E[1][0] - E[0][1]};
  }

  [[nodiscard]] bool is_posture(const Numbers& q) const {
    const Matrix4 T = end_of(arm, q);
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 4; ++j) most = std::fmax(most, std::fabs(T[i][j] - end[i][j]));
    return most < 1e-8;
  }
};

Numbers random_values(RandomSource& random, const Arm& arm) {
  Numbers q;
  for (const DhJoint& joint : arm)
    q.push_back(joint.slides ? random.between(-1, 1) : random.between(-3.1, 3.1));
  return q;
}

Arm random_arm(RandomSource& random) {
  Arm arm;
  for (DhJoint& joint : arm)
    joint = {random.between(-1, 1), random.between(-1.5, 1.5), random.between(-1, 1),
             random.between(-3, 3)};
  return arm;
}

void expect_all(const Arm& arm, const Numbers& planted, const Solutions& solutions,
                RandomSource& random, int starts) {
  EXPECT_TRUE(has_near(solutions, planted, 1e-8));
  const Gap gap{arm, end_of(arm, planted)};
  for (const CertainSolution& s : solutions.found) EXPECT_TRUE(gap.is_posture(middle_of(s.values)));
  for (int start = 0; start < starts; ++start) {
    const Numbers found = newton(gap, random_values(random, arm));
    if (!found.empty() && gap.is_posture(found)) {
      EXPECT_TRUE(has_near(solutions, found, 1e-6));
    }
  }
}

/// A list of one arm is none of a changed one, or of the file of another.
void expect_proof(const std::string& model) {
  const Certified made = certified(model);
  ASSERT_FALSE(made.text.empty()) << made.status.obstacle();
  const std::string plain = without_sum(made.text);
  EXPECT_EQ(outcome(made.text, model), Outcome::kVerified);
  EXPECT_NE(outcome(plain, replaced(model, "prismatic", "revolute")), Outcome::kVerified);
  EXPECT_NE(outcome(replaced(made.text, "sliding-joint", "joint")), Outcome::kVerified);
  const std::size_t pair = made.text.find("opposite ") + 9;
  for (const char other : {'1', '2', '3'}) {
    if (other == made.text[pair]) continue;
    std::string changed = made.text;
    changed[pair] = other;
    EXPECT_EQ(outcome(changed), Outcome::kRejected);
  }
  const Lines genuine = lines_of(made.text);
  for (std::size_t k = 0; k < made.solutions.found.size(); ++k) {
    Lines fewer = genuine;
    fewer.erase(fewer.begin() + std::ptrdiff_t(first(genuine, "solution") + k));
    if (made.solutions.found.size() == 1) continue;
    EXPECT_EQ(
        outcome(joined(claiming(fewer, "COMPLETE", format::describe_arm(6, false, false, false),
                                "posture", "postures"))),
        Outcome::kRejected)
        << k;
  }
}

TEST(PosturesOfAnArmWithOneSlide, AreThoseThatNewtonFinds) {
  RandomSource random(31);
  int complete = 0;
  const int rounds = trials(6, 60);
  for (int round = 0; round < rounds; ++round) {
    Arm arm = random_arm(random);
    arm[std::size_t(round) % 6].slides = true;
    const Numbers planted = random_values(random, arm);
    const Solutions solutions = solved(text_of(arm, planted));
    if (!is_complete(solutions)) continue;
    ++complete;
    expect_all(arm, planted, solutions, random, 60);
    if (round < 6) expect_proof(text_of(arm, planted));
  }
  EXPECT_GE(complete, rounds - 1);
}

TEST(PosturesOfTheStanfordArm, AreEight) {
  const double right = std::numbers::pi / 2;
  Arm arm{{{0, -right, 0.412},
           {0, right, 0.154},
           {0, 0, 0, -right, true},
           {0, -right},
           {0, right},
           {0, 0, 0.263}}};
  RandomSource random(32);
  for (int round = 0; round < 6; ++round) {
    Numbers q = random_values(random, arm);
    q[2] = 0.3 + 0.1 * round;
    const Solutions solutions = solved(text_of(arm, q));
    EXPECT_TRUE(is_complete(solutions)) << solutions.obstacle;
    EXPECT_EQ(solutions.found.size(), 8U);
    expect_all(arm, q, solutions, random, 20);
  }
}

/// The rail keeps its value, and the six joints behind it turn; or the rail moves, and a joint keeps its angle.
TEST(PosturesOfAnArmOnARail, AreVerified) {
  const std::string model =
      "regulus = 1\nname = \"on a rail\"\n[serial]\nunit = \"m\"\njoints = [\n"
      "{ name = \"rail\", type = \"prismatic\", axis = [1, 0, 0], rpy = [0.1, 0, 0] },\n"
      "{ name = \"a\", axis = [0, 0, 1], xyz = [0, 0.1, 0.3] },\n"
      "{ name = \"b\", axis = [0, 1, 0], xyz = [0.1, 0, 0.2] },\n"
      "{ name = \"c\", axis = [0, 1, 0], xyz = [0, 0.05, 0.5] },\n"
      "{ name = \"d\", axis = [1, 0, 0], xyz = [0.1, 0, 0.1] },\n"
      "{ name = \"e\", axis = [0, 1, 0], xyz = [0.4, 0, 0] },\n"
      "{ name = \"f\", axis = [1, 0, 0], xyz = [0.1, 0.02, 0] },\n]\n"
      "[motion.at]\nrail = 0.2\na = 0.3\nb = 0.4\nc = -0.5\nd = 0.6\ne = 0.7\nf = 0.1\n";
  const Certified held =
      certified(model, {"rail=0.2", "x=0.9", "y=0.3", "z=0.8", "roll=0.1", "pitch=0.2", "yaw=0.3"});
  ASSERT_TRUE(is_complete(held.solutions));
  ASSERT_FALSE(held.text.empty()) << held.status.obstacle();
  EXPECT_NE(held.text.find("held-sliding-joint"), std::string::npos);
  const std::string plain = without_sum(held.text);
  EXPECT_EQ(verified(plain, model, true).outcome, Outcome::kVerified);
  EXPECT_NE(
      verified(plain, replaced(model, "axis = [1, 0, 0], rpy", "axis = [-1, 0, 0], rpy"), true)
          .outcome,
      Outcome::kVerified);
  EXPECT_NE(outcome(replaced(held.text, "held-sliding-joint", "held-joint")), Outcome::kVerified);
}

/// Rails along x and z, one directly behind the other, and a wrist: the last four joints turn.
TEST(PosturesOfAnArmWithTwoSlides, AreThoseThatNewtonFinds) {
  const double right = std::numbers::pi / 2;
  const Arm arm{{{0, 0, 0.5},
                 {0.1, -right, 0, 0, true},
                 {0, right, 0, right, true},
                 {0.2, right, 0.1},
                 {0, -right, 0.3},
                 {0, 0, 0.1}}};
  RandomSource random(33);
  for (int round = 0; round < trials(2, 8); ++round) {
    const Numbers planted = random_values(random, arm);
    const Solutions solutions = solved(text_of(arm, planted));
    ASSERT_TRUE(is_complete(solutions)) << solutions.obstacle;
    EXPECT_EQ(solutions.how.find("of those with"), std::string::npos) << solutions.how;
    expect_all(arm, planted, solutions, random, 40);
  }
}

TEST(PosturesOfAGantry, AreListedBeyondTheirRanges) {
  const auto gantry = [](const char* range) {
    return fmt::format(
        "regulus = 1\nname = \"gantry\"\n[serial]\nunit = \"m\"\njoints = [\n"
        "{{ name = \"px\", type = \"prismatic\", axis = [1, 0, 0], range = {} }},\n"
        "{{ name = \"py\", type = \"prismatic\", axis = [0, 1, 0], range = [-2, 2] }},\n"
        "{{ name = \"pz\", type = \"prismatic\", axis = [0, 0, 1], range = [-2, 2] }},\n"
        "{{ name = \"a\", axis = [0, 0, 1], xyz = [0, 0, -0.2], range = [-3, 3] }},\n"
        "{{ name = \"b\", axis = [0, 1, 0], xyz = [0.05, 0, 0], range = [-3, 3] }},\n"
        "{{ name = \"c\", axis = [1, 0, 0], xyz = [0.1, 0, 0], range = [-3.2, 3.2] }},\n]\n"
        "[motion.there]\ntool = [0.6, 0.5, -0.1, 0.1, 0.2, 0.3]\n",
        range);
  };
  const Solutions all = solved(gantry("[0, 0.9]")), some = solved(gantry("[0, 0.5]"));
  ASSERT_TRUE(is_complete(all));
  ASSERT_TRUE(is_complete(some));
  ASSERT_EQ(all.found.size(), 2U);
  ASSERT_EQ(some.found.size(), 2U);
  EXPECT_EQ(all.found.back().limits, WithinLimits::kWithin);
  EXPECT_EQ(some.found.back().limits, WithinLimits::kBeyond);
  EXPECT_GT(some.found.back().values[0].lo, 0.5);
}

/// With a turn between them two slides may both be far out: they are looked for in their ranges, and the
/// list says so.
TEST(PosturesOfAnArmWithATurnBetweenSlides, AreThoseInTheRanges) {
  Arm arm = {{{0, 0.4, 0, 0.3, true},
              {0.5, 1.2, 0.2},
              {0.1, -0.7, 0, 0.2, true},
              {0.3, 1.4, 0.1},
              {0.2, -1.3, 0.4},
              {0, 0, 0.1}}};
  const Solutions solutions =
      solved(text_of(arm, Numbers(6), 1),
             {"q1=0.3", "q2=0.5", "q3=-0.2", "q4=0.9", "q5=-0.4", "q6=1"}, 40'000);
  EXPECT_NE(solutions.how.find(", of those with q1 in ["), std::string::npos) << solutions.how;
}

}  // namespace
}  // namespace regulus::detail::test::sliding_arms_test
