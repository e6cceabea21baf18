// SPDX-License-Identifier: GPL-3.0-or-later
// All configurations of closures, against oracles that share nothing with the search.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/property/solve/solved.hpp"

namespace regulus::detail {
namespace {

using test::has_near;
using test::is_complete;
using test::solved;

/// A model with these equations; each unknown starts at 0 and has the range [-reach, reach].
std::string system_of(const std::vector<std::string>& unknowns, const std::string& unit,
                      const std::vector<std::string>& equations, double reach) {
  std::string declared, listed, starts = "t = 0", ranges;
  for (const std::string& name : unknowns) {
    declared += fmt::format("{}{} = \"{}\"", declared.empty() ? "" : ", ", name, unit);
    starts += fmt::format(", {} = 0", name);
    ranges += fmt::format("{}{} = [{}, {}]", ranges.empty() ? "" : ", ", name, -reach, reach);
  }
  for (const std::string& equation : equations) listed += fmt::format("  \"{}\",\n", equation);
  return fmt::format(
      "regulus = 1\nname = \"system\"\n[pose]\nt = \"1\"\n[closure]\nunknowns = {{ {} }}\n"
      "equations = [\n{}]\nstart = {{ {} }}\nrange = {{ {} }}\n[motion.only]\nt = 0\n",
      declared, listed, starts, ranges);
}

/// A planar platform on three legs by its anchors.
struct Platform {
  std::array<std::array<double, 2>, 3> base, platform;
  std::array<double, 3> legs;

  [[nodiscard]] std::array<double, 3> legs_at(double x, double y, double phi) const {
    std::array<double, 3> lengths{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [u, v] = point(i, phi);
      lengths[i] = std::hypot(x + u, y + v);
    }
    return lengths;
  }

  /// The poses, by the angle: the differences of the equations are linear in x and y, and a root of
  /// the rest is between two angles of a fine grid. Negative: two roots may be between two of them.
  [[nodiscard]] int count() const {
    constexpr int kSteps = 200'000;
    int roots = 0;
    double before = rest(0), before_that = rest(-2 * std::numbers::pi / kSteps);
    for (int i = 1; i <= kSteps; ++i) {
      const double now = rest(2 * std::numbers::pi * i / kSteps);
      if ((now < 0) != (before < 0)) ++roots;
      const bool touches = std::fabs(before) < std::fabs(now) &&
                           std::fabs(before) < std::fabs(before_that) &&
                           (now < 0) == (before < 0) && (before_that < 0) == (before < 0);
      if (touches && std::fabs(before) < 10 * std::fabs(now - before)) return -1;
      before_that = before, before = now;
    }
    return roots;
  }

  [[nodiscard]] std::string text() const {
    std::string let, equations;
    for (std::size_t i = 0; i < 3; ++i) {
      let += fmt::format("u{0} = \"x + ({1:.17g})*cos(phi) - ({2:.17g})*sin(phi) - ({3:.17g})\"\n",
                         i, platform[i][0], platform[i][1], base[i][0]);
      let += fmt::format("v{0} = \"y + ({1:.17g})*sin(phi) + ({2:.17g})*cos(phi) - ({3:.17g})\"\n",
                         i, platform[i][0], platform[i][1], base[i][1]);
      equations += fmt::format("\"u{0}^2 + v{0}^2 - l{0}^2\", ", i);
    }
    return fmt::format(
        "regulus = 1\nname = \"3-RPR\"\n[pose]\nl0 = \"1\"\nl1 = \"1\"\nl2 = \"1\"\n[let]\n{}"
        "[closure]\nunknowns = {{ x = \"1\", y = \"1\", phi = \"rad\" }}\nequations = [{}]\n"
        "start = {{ l0 = 1, l1 = 1, l2 = 1, x = 0, y = 0, phi = 0 }}\n"
        "[motion.only]\nl0 = \"{:.17g}\"\nl1 = \"{:.17g}\"\nl2 = \"{:.17g}\"\n",
        let, equations, legs[0], legs[1], legs[2]);
  }

 private:
  /// From an anchor of the base to that of the platform at the origin.
  [[nodiscard]] std::array<double, 2> point(std::size_t i, double phi) const {
    const double c = std::cos(phi), s = std::sin(phi);
    return {platform[i][0] * c - platform[i][1] * s - base[i][0],
            platform[i][0] * s + platform[i][1] * c - base[i][1]};
  }

  /// The first equation times the square of the determinant of the other two, at their x and y.
  [[nodiscard]] double rest(double phi) const {
    std::array<double, 3> u{}, v{}, w{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [a, b] = point(i, phi);
      u[i] = a, v[i] = b, w[i] = a * a + b * b - legs[i] * legs[i];
    }
    const double a1 = 2 * (u[1] - u[0]), b1 = 2 * (v[1] - v[0]), c1 = w[0] - w[1];
    const double a2 = 2 * (u[2] - u[0]), b2 = 2 * (v[2] - v[0]), c2 = w[0] - w[2];
    const double det = a1 * b2 - a2 * b1, x = c1 * b2 - c2 * b1, y = a1 * c2 - a2 * c1;
    return x * x + y * y + 2 * det * (u[0] * x + v[0] * y) + w[0] * det * det;
  }
};

TEST(AllPosesOfRandomPlanarPlatforms, AreAsManyAsAGridOfAnglesCounts) {
  std::mt19937 random(42);
  std::uniform_real_distribution<double> place(-1, 1), angle(-3, 3);
  int counted = 0, most = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Platform robot{};
    for (auto* points : {&robot.base, &robot.platform})
      for (auto& point : *points)
        for (double& coordinate : point) coordinate = place(random);
    const double x = place(random), y = place(random), phi = angle(random);
    robot.legs = robot.legs_at(x, y, phi);
    const int count = robot.count();
    if (count < 0) continue;
    const Solutions solutions = solved(robot.text());
    EXPECT_TRUE(is_complete(solutions)) << trial << ": " << solutions.obstacle;
    EXPECT_EQ(int(solutions.found.size()), count) << "trial " << trial;
    EXPECT_TRUE(has_near(solutions, {x, y, phi}, 1e-6)) << "trial " << trial;
    ++counted, most = std::max(most, count);
  }
  EXPECT_GE(counted, 50);
  EXPECT_GE(most, 4);
}

TEST(AllSolutionsOfRandomQuadrics, ContainThePlantedOne) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> coefficient(-9, 9), place(-15, 15);
  int complete = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const std::size_t n = 2 + std::size_t(trial % 2);
    const std::vector<std::string> names = {"x", "y", "z"};
    std::vector<int> root(n);
    for (int& value : root) value = place(random);
    std::vector<std::string> equations;
    for (std::size_t e = 0; e < n; ++e) {
      std::string equation;
      double value = 0;
      for (std::size_t i = 0; i < n; ++i) {
        const int linear = coefficient(random);
        equation += fmt::format("+({})*{}", linear, names[i]);
        value += linear * (root[i] / 10.0);
        for (std::size_t j = i; j < n; ++j) {
          const int quadratic = coefficient(random);
          equation += fmt::format("+({})*{}*{}", quadratic, names[i], names[j]);
          value += quadratic * (root[i] / 10.0) * (root[j] / 10.0);
        }
      }
      equations.push_back(fmt::format("{} - ({})/100", equation, std::lround(100 * value)));
    }
    const Solutions solutions =
        solved(system_of({names.begin(), names.begin() + std::ptrdiff_t(n)}, "1", equations, 5));
    complete += is_complete(solutions) ? 1 : 0;
    std::vector<double> planted;
    for (const int value : root) planted.push_back(value / 10.0);
    EXPECT_TRUE(!is_complete(solutions) || has_near(solutions, planted)) << "trial " << trial;
    EXPECT_LE(solutions.found.size(), std::size_t{1} << n);
    for (const CertainSolution& s : solutions.found) EXPECT_NE(s.sign, 0);
  }
  EXPECT_GE(complete, 57);
}

TEST(AllSolutions, ThatDifferByTurnsAreOne) {
  const std::string text = system_of({"a"}, "rad", {"sin(a)"}, 100);
  const Solutions solutions = solved(text);
  EXPECT_TRUE(is_complete(solutions));
  EXPECT_EQ(solutions.found.size(), 2U);
  EXPECT_TRUE(has_near(solutions, {std::numbers::pi}));
  const Solutions thirds = solved(system_of({"a"}, "deg", {"cos(3*a) - 1/2"}, 1000));
  EXPECT_TRUE(is_complete(thirds));
  EXPECT_EQ(thirds.found.size(), 6U);
}

TEST(AllSolutions, OfAnAngleThatIsAlsoANumberAreThoseOfItsRange) {
  const Solutions solutions = solved(system_of({"a"}, "rad", {"sin(a) - a/10"}, 20));
  EXPECT_TRUE(is_complete(solutions));
  EXPECT_EQ(solutions.found.size(), 7U);
}

TEST(AllSolutions, AtTheBorderOfARangeAreTold) {
  const Solutions solutions = solved(system_of({"x"}, "1", {"x^2 - 25"}, 5));
  EXPECT_TRUE(is_complete(solutions));
  EXPECT_EQ(solutions.found.size(), 2U);
  for (const CertainSolution& s : solutions.found) EXPECT_EQ(s.limits, WithinLimits::kUnknown);
}

TEST(AllSolutions, AreNotCompleteWhereTwoMeet) {
  for (const auto& equations :
       std::vector<std::vector<std::string>>{{"x^2 + y^2 - 1", "x - 1"},
                                             {"x^2 + y^2 - 2", "(x - 2)^2 + (y - 2)^2 - 2"},
                                             {"(x - 1/3)^2", "y - x"},
                                             {"(x - 1/3)^3", "y - x"},
                                             {"x^2 - y^2", "x*y"}})
    EXPECT_FALSE(is_complete(solved(system_of({"x", "y"}, "1", equations, 3)))) << equations[0];
  EXPECT_FALSE(is_complete(solved(system_of({"a"}, "rad", {"cos(a) - 1"}, 7))));
}

TEST(AllSolutions, AreNotCompleteWhereThereAreInfinitelyMany) {
  const Solutions curve =
      solved(system_of({"x", "y"}, "1", {"x^2 + y^2 - 1", "2*x^2 + 2*y^2 - 2"}, 3));
  EXPECT_FALSE(is_complete(curve));
  EXPECT_TRUE(curve.found.empty());
  EXPECT_FALSE(curve.open.empty());
  EXPECT_FALSE(is_complete(solved(system_of({"x", "y"}, "1", {"x - 1", "(x - 1)*y"}, 3))));
}

TEST(AllSolutions, ThatAreNearAreToldApartOrLeftOpen) {
  for (const char* gap : {"1e-3", "1e-6", "1e-8", "1e-12"}) {
    const Solutions near = solved(
        system_of({"x", "y"}, "1", {fmt::format("(x - 1/3)*(x - 1/3 - {})", gap), "y - x"}, 3));
    if (is_complete(near)) {
      EXPECT_EQ(near.found.size(), 2U) << gap;
    }
  }
}

TEST(AllSolutions, CanBeNone) {
  const Solutions none = solved(system_of({"x", "y"}, "1", {"x^2 + y^2 - 1", "x + y - 2"}, 3));
  EXPECT_TRUE(is_complete(none));
  EXPECT_TRUE(none.found.empty());
  EXPECT_TRUE(none.open.empty());
}

TEST(AllSolutions, OfASearchThatALimitEndsAreNotComplete) {
  const Solutions ended = solved(system_of({"x", "y"}, "1", {"x^2 + y^2 - 1", "x - y"}, 3), {}, 1);
  EXPECT_FALSE(is_complete(ended));
  EXPECT_EQ(ended.stopped_by, Reason::kBoxBudget);
  EXPECT_FALSE(ended.open.empty());
}

}  // namespace
}  // namespace regulus::detail
