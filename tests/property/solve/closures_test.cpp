// SPDX-License-Identifier: GPL-3.0-or-later
// All configurations of closures, against oracles that share nothing with the search.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/property/solve/planar_platform.hpp"
#include "tests/property/solve/solved.hpp"

namespace regulus::detail {
namespace {

using test::has_near;
using test::is_complete;
using test::PlanarPlatform;
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

std::string text_of(const PlanarPlatform& robot) {
  std::string let, equations;
  for (std::size_t i = 0; i < 3; ++i) {
    let += fmt::format("u{0} = \"x + ({1:.17g})*cos(phi) - ({2:.17g})*sin(phi) - ({3:.17g})\"\n", i,
                       robot.platform[i][0], robot.platform[i][1], robot.base[i][0]);
    let += fmt::format("v{0} = \"y + ({1:.17g})*sin(phi) + ({2:.17g})*cos(phi) - ({3:.17g})\"\n", i,
                       robot.platform[i][0], robot.platform[i][1], robot.base[i][1]);
    equations += fmt::format("\"u{0}^2 + v{0}^2 - l{0}^2\", ", i);
  }
  return fmt::format(
      "regulus = 1\nname = \"3-RPR\"\n[pose]\nl0 = \"1\"\nl1 = \"1\"\nl2 = \"1\"\n[let]\n{}"
      "[closure]\nunknowns = {{ x = \"1\", y = \"1\", phi = \"rad\" }}\nequations = [{}]\n"
      "start = {{ l0 = 1, l1 = 1, l2 = 1, x = 0, y = 0, phi = 0 }}\n"
      "[motion.only]\nl0 = \"{:.17g}\"\nl1 = \"{:.17g}\"\nl2 = \"{:.17g}\"\n",
      let, equations, robot.legs[0], robot.legs[1], robot.legs[2]);
}

TEST(AllPosesOfRandomPlanarPlatforms, AreAsManyAsAGridOfAnglesCounts) {
  std::mt19937 random(42);
  std::uniform_real_distribution<double> place(-1, 1), angle(-3, 3);
  int counted = 0, most = 0;
  for (int trial = 0; trial < 60; ++trial) {
    PlanarPlatform robot{};
    for (auto* points : {&robot.base, &robot.platform})
      for (auto& point : *points)
        for (double& coordinate : point) coordinate = place(random);
    const double x = place(random), y = place(random), phi = angle(random);
    robot.legs = robot.legs_at(x, y, phi);
    const int count = robot.count();
    if (count < 0) continue;
    const Solutions solutions = solved(text_of(robot));
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
