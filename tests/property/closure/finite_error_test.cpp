// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/finite_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/property/closure/checked_closures.hpp"
#include "tests/property/closure/four_bars.hpp"

namespace regulus {
namespace {

using test::rpr;

FiniteErrors bound(const std::string& text, double gap = 0.01) {
  SearchOptions search;
  search.engine = Engine::kInterpreted;
  search.threads = 1;
  search.time_limit = 60;
  ModelOptions options;
  options.motion = "m";
  const Request request = read_request(text, options);
  QuantityOptions quantity;
  quantity.quantity = "error";
  return bound_finite_errors(request, unknowns_of(request, quantity, ""), gap, search, {}, nullptr);
}

/// Published figures, which first order misses by a third.
TEST(FiniteError, MeetsThePublishedFiguresOfA3Rpr) {
  const struct {
    const char* spread;
    double errors[3];
  } cases[] = {{"0.01", {0.03330, 0.04744, 0.01605}},
               {"0.05", {0.17043, 0.24092, 0.08127}},
               {"0.2", {0.93150, 1.03156, 0.44133}}};
  for (const auto& [spread, errors] : cases) {
    const std::string s = spread;
    const FiniteErrors found =
        bound(rpr("l1 = \"sqrt(50)\"\nl2 = \"sqrt(26)\"\nl3 = 5\nerror = { l1 = " + s +
                  ", l2 = " + s + ", l3 = " + s + " }\n"));
    ASSERT_EQ(found.obstacle, "");
    for (std::size_t i = 0; i < 3; ++i) {
      const FiniteError& error = found.unknowns[i];
      EXPECT_TRUE(error.is_closed) << error.name;
      EXPECT_LE(error.attained, errors[i] + 1e-5) << error.name;
      EXPECT_GE(error.proved, errors[i] - 1e-5) << error.name;
      EXPECT_LE(error.proved - error.attained, 0.0101 * error.proved) << error.name;
    }
  }
}

/// A four-bar that moves, with errors of the motor and of two lengths, against its closed form.
TEST(FiniteError, BoundsWhatTheClosedFormGivesOverAMotion) {
  const test::FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  std::string text = linkage.text(1, 0.5, 1.5, 0.002);
  text += "error = { theta = 0.01 }\n";
  const FiniteErrors found = bound(text, 0.05);
  ASSERT_EQ(found.obstacle, "");
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0.5, 1.5), part(-1, 1);
  double most[2] = {0, 0};
  for (int i = 0; i < 20000; ++i) {
    // Mostly corners: that is where errors are largest.
    const auto error = [&](double spread) {
      const double x = part(random);
      return spread * (random() % 4 == 0 ? x : x < 0 ? -1 : 1);
    };
    test::FourBar other = linkage;
    const double theta = place(random);
    other.a += error(0.002), other.b += error(0.002);
    const test::FourBar::Angles actual = other.at(theta + error(0.01)), nominal = linkage.at(theta);
    most[0] = std::fmax(most[0], std::fabs(actual.phi - nominal.phi));
    most[1] = std::fmax(most[1], std::fabs(actual.psi - nominal.psi));
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const FiniteError& error = found.unknowns[i];
    EXPECT_TRUE(error.is_closed);
    EXPECT_LE(most[i], error.proved);
    EXPECT_GE(most[i], 0.97 * error.attained);
  }
}

/// A constraint speaks of a pose parameter whose value the motion gives.
TEST(FiniteError, KeepsTheConstraintsOfTheMotion) {
  const std::string pose =
      "l1 = \"sqrt(50)\"\nl2 = \"sqrt(26)\"\nl3 = 5\nerror = { l1 = 0.01, l2 = 0.01, l3 = 0.01 }\n";
  EXPECT_EQ(bound(rpr(pose + "constraints = [\"l1 - 8\"]\n")).obstacle, "");
  EXPECT_NE(bound(rpr(pose + "constraints = [\"7 - l1\", \"l1 - 7\"]\n")).obstacle, "");
}

TEST(FiniteError, SaysIfTheBranchIsNotCertain) {
  const FiniteErrors found = bound(
      rpr("l1 = \"sqrt(50)\"\nl2 = \"sqrt(26)\"\nl3 = 5\nerror = { l1 = 1, l2 = 1, l3 = 1 }\n"));
  EXPECT_NE(found.obstacle, "");
  EXPECT_TRUE(found.unknowns.empty());
}

}  // namespace
}  // namespace regulus
