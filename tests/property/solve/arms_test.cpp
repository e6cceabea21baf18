// SPDX-License-Identifier: GPL-3.0-or-later
// All postures of arms: planted ones are in the list, each is at the frame by doubles of the test's
// own, and arms with known numbers of postures have them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

#include "tests/property/solve/solved.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail {
namespace {

using test::has_near;
using test::is_complete;
using test::solved;

struct DhJoint {
  double a, alpha, d;
};
using Arm = std::array<DhJoint, 6>;
using Matrix4 = std::array<std::array<double, 4>, 4>;

Matrix4 product(const Matrix4& A, const Matrix4& B) {
  Matrix4 C{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k) C[i][j] += A[i][k] * B[k][j];
  return C;
}

/// Rz(q)·Tz(d)·Tx(a)·Rx(alpha) of each joint, but the last: its a and alpha do not matter.
Matrix4 end_of(const Arm& arm, const std::vector<double>& q) {
  Matrix4 T{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  for (std::size_t i = 0; i < 6; ++i) {
    const double c = std::cos(q[i]), s = std::sin(q[i]);
    const double ca = std::cos(arm[i].alpha), sa = std::sin(arm[i].alpha);
    T = product(T, {{{c, -s * ca, s * sa, arm[i].a * c},
                     {s, c * ca, -c * sa, arm[i].a * s},
                     {0, sa, ca, arm[i].d},
                     {0, 0, 0, 1}}});
  }
  return T;
}

std::string text_of(const Arm& arm, const std::vector<double>& q) {
  std::string joints, motion;
  for (std::size_t i = 0; i < 6; ++i) {
    joints += fmt::format("{{ name = \"q{}\", a = {:.17g}, alpha = {:.17g}, d = {:.17g} }},\n",
                          i + 1, arm[i].a, arm[i].alpha, arm[i].d);
    motion += fmt::format("q{} = {:.17g}\n", i + 1, q[i]);
  }
  return fmt::format(
      "regulus = 1\nname = \"arm\"\n[serial]\nconvention = \"standard-dh\"\njoints = [\n{}]\n"
      "[motion.at]\n{}",
      joints, motion);
}

double distance(const Matrix4& A, const Matrix4& B) {
  double most = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) most = std::fmax(most, std::fabs(A[i][j] - B[i][j]));
  return most;
}

void expect_reach(const Arm& arm, const std::vector<double>& planted, const Solutions& solutions) {
  const Matrix4 end = end_of(arm, planted);
  EXPECT_TRUE(has_near(solutions, planted));
  for (const CertainSolution& s : solutions.found) {
    std::vector<double> q;
    for (const Interval& value : s.values) q.push_back(mid(value));
    EXPECT_LT(distance(end_of(arm, q), end), 1e-8);
    EXPECT_NE(s.sign, 0);
  }
}

std::vector<double> random_posture(std::mt19937& random) {
  std::uniform_real_distribution<double> angle(-3.1, 3.1);
  std::vector<double> q(6);
  for (double& value : q) value = angle(random);
  return q;
}

TEST(AllPosturesOfGeneralArms, ContainThePlantedOne) {
  std::mt19937 random(16);
  std::uniform_real_distribution<double> length(-1, 1), angle(-1.5, 1.5);
  int complete = 0;
  std::size_t most = 0;
  for (int trial = 0; trial < test::trials(6, 12); ++trial) {
    Arm arm{};
    for (DhJoint& joint : arm) joint = {length(random), angle(random), length(random)};
    arm[5].a = arm[5].alpha = 0;
    const std::vector<double> q = random_posture(random);
    const Solutions solutions = solved(text_of(arm, q));
    if (!is_complete(solutions)) continue;
    ++complete, most = std::max(most, solutions.found.size());
    expect_reach(arm, q, solutions);
    EXPECT_EQ(solutions.found.size() % 2, 0U);  // complex ones come in pairs, of 16
    EXPECT_LE(solutions.found.size(), 16U);
  }
  EXPECT_GE(complete, test::trials(5, 11));
  EXPECT_GE(most, 4U);
}

TEST(AllPosturesOfArmsWithASphericalWrist, ContainThePlantedOne) {
  const double right = std::numbers::pi / 2;
  const Arm arm = {{{0.1, -right, 0.4},
                    {0.45, 0, 0},
                    {0.03, right, 0},
                    {0, -right, 0.42},
                    {0, right, 0},
                    {0, 0, 0.08}}};
  std::mt19937 random(8);
  for (int trial = 0; trial < 12; ++trial) {
    const std::vector<double> q = random_posture(random);
    const Solutions solutions = solved(text_of(arm, q));
    EXPECT_TRUE(is_complete(solutions)) << solutions.obstacle;
    expect_reach(arm, q, solutions);
    EXPECT_TRUE(solutions.found.size() == 4 || solutions.found.size() == 8)
        << solutions.found.size();
  }
}

/// A range may begin beyond a turn about 0.
TEST(AllPosturesOfAnArm, HaveValuesWithinTheLimitsOfTheirJoints) {
  const double right = std::numbers::pi / 2, turn = 4 * right;
  const Arm arm = {{{0.1, -right, 0.4},
                    {0.45, 0, 0},
                    {0.03, right, 0},
                    {0, -right, 0.42},
                    {0, right, 0},
                    {0, 0, 0.08}}};
  const std::vector<double> q = {0.3 + turn, 0.5, -0.4, 0.6, 0.8, -0.2};
  std::string text = text_of(arm, q);
  const auto limit = [&text](const std::string& before, const std::string& range) {
    for (std::size_t at = text.find(before); at != std::string::npos;
         at = text.find(before, at + 1))
      text.insert(text.find(" }", at), ", range = " + range);
  };
  limit("{ name = \"q1\"", "[1.8, 8.5]");
  for (int joint = 2; joint <= 6; ++joint)
    limit(fmt::format("{{ name = \"q{}\"", joint), "[-4, 4]");
  text.erase(text.find("[motion.at]"));
  std::vector<std::string> at;
  for (std::size_t i = 0; i < q.size(); ++i) at.push_back(fmt::format("q{}={:.17g}", i + 1, q[i]));
  const Solutions solutions = solved(text, at);
  ASSERT_TRUE(is_complete(solutions)) << solutions.obstacle;
  int moved = 0;
  for (const CertainSolution& s : solutions.found) {
    EXPECT_EQ(s.limits, WithinLimits::kWithin);
    EXPECT_GE(s.values[0].lo, 1.8);
    EXPECT_LE(s.values[0].hi, 8.5);
    moved += s.values[0].lo > turn / 2;
  }
  EXPECT_GE(moved, 1);
  expect_reach(arm, q, solutions);
}

TEST(AllPosturesOfAnArm, AreNotCompleteAtASingularOne) {
  const double right = std::numbers::pi / 2;
  const Arm arm = {{{0.1, -right, 0.4},
                    {0.45, 0, 0},
                    {0.03, right, 0},
                    {0, -right, 0.42},
                    {0, right, 0},
                    {0, 0, 0.08}}};
  // The wrist is stretched: q4 and q6 turn alike.
  EXPECT_FALSE(is_complete(solved(text_of(arm, {0.3, 0.4, 0.5, 0.2, 0, 0.1}), {}, 20'000)));
}

std::string model(const std::string& name) {
  std::ifstream file(REGULUS_SOURCE_DIR "/models/" + name + ".toml");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(PublishedSolutions, AreAsManyAsIsKnown) {
  const Solutions loop = solved(model("manocha_canny"));
  EXPECT_TRUE(is_complete(loop)) << loop.obstacle;
  EXPECT_EQ(loop.found.size(), 16U);
  const Solutions butterfly = solved(model("double_butterfly"), {"theta=67.38"});
  EXPECT_TRUE(is_complete(butterfly));
  ASSERT_EQ(butterfly.found.size(), 6U);
  EXPECT_TRUE(has_near(butterfly, {-10.81285, -2.02048, -2.92286, -2.18392}, 1e-5));
  EXPECT_TRUE(has_near(butterfly, {6.74390, 8.69022, 0.51832, 1.29745}, 1e-5));
  const Solutions alias = solved(model("alias_3rpr"), {"l1=sqrt(50)", "l2=sqrt(26)", "l3=5"});
  EXPECT_TRUE(is_complete(alias));
  ASSERT_EQ(alias.found.size(), 2U);
  EXPECT_TRUE(has_near(alias, {5, 5, 0}));
  EXPECT_TRUE(has_near(alias, {3.369707132, 6.216516219, -0.8067834380}, 1e-8));
}

TEST(PublishedSolutions, OfAPlanarPlatformHaveTheirSigns) {
  const Solutions poses = solved(model("rpr_6"));
  EXPECT_TRUE(is_complete(poses));
  ASSERT_EQ(poses.found.size(), 6U);
  const std::array<std::array<double, 4>, 6> known = {{{-14.89613, 1.58296, 0.245310, 1},
                                                       {-13.41994, -6.65625, 0.585673, -1},
                                                       {-8.72660, 12.17567, -0.986974, -1},
                                                       {-5.49566, -13.93550, -0.047331, 1},
                                                       {14.67394, -3.01260, 2.132904, 1},
                                                       {14.92013, -1.33792, 1.002039, -1}}};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_NEAR(mid(poses.found[i].values[j]), known[i][j], 1e-5);
    EXPECT_EQ(poses.found[i].sign, int(known[i][3]));
  }
}

/// Legs that meet in pairs have at most 16 complex poses, and the platform's own is among them.
TEST(AllPosesOfLegsInPairs, ContainThePlantedOne) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(-1, 1);
  int complete = 0;
  for (int i = 0; i < 10; ++i) {
    const double x = 2 * part(random), y = 2 * part(random), z = 9 + 2 * part(random);
    std::vector<std::string> at = {fmt::format("x={}", x), fmt::format("y={}", y),
                                   fmt::format("z={}", z)};
    for (const char* angle : {"roll", "pitch", "yaw"})
      at.push_back(fmt::format("{}={}", angle, 0.3 * part(random)));
    const Solutions poses = solved(model("octahedral"), at);
    if (is_complete(poses)) {
      ++complete;
      EXPECT_TRUE(has_near(poses, {x, y, z}, 1e-8)) << x << ' ' << y << ' ' << z;
      EXPECT_EQ(poses.complex_found, 16U);
      EXPECT_EQ(poses.found.size() % 2, 0U);  // mirrored in the plane of the base
    }
  }
  EXPECT_GE(complete, 9);
}

TEST(PublishedSolutions, OfDietmaiersPlatformAreForty) {
  const Solutions poses = solved(model("dietmaier"));
  EXPECT_TRUE(is_complete(poses));
  ASSERT_EQ(poses.found.size(), 40U);
  int sum = 0;
  for (const CertainSolution& s : poses.found) {
    EXPECT_NE(s.sign, 0);
    sum += s.sign;
  }
  EXPECT_EQ(sum, 0);  // 20 of each sign
}

}  // namespace
}  // namespace regulus::detail
