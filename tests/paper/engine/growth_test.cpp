// SPDX-License-Identifier: GPL-3.0-or-later
// The growth of the boxes with the tolerance and the angles; tests/paper/GROWTH.md has the tables.
#include "tests/paper/tables/growth.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace regulus::detail::test {
namespace {

TEST(Growth, TheExponentOfAPowerLawIsItsPower) {
  std::vector<GrowthPoint> points;
  for (const double x : {0.01, 0.02, 0.05, 0.1}) points.push_back({x, 3 * std::pow(x, 2.5)});
  EXPECT_NEAR(exponent(points).value(), 2.5, 1e-12);
  points.resize(2);
  EXPECT_FALSE(exponent(points));
}

double exponent_without(const Series& series, const std::vector<std::string>& without) {
  SearchOptions search;
  search.without = without;
  std::vector<GrowthPoint> points;
  for (const double x : {10, 20, 30, 40}) {
    const PreparedSearch p = prepare(question_at(series, x).options(), search);
    const Result result = solve(p.problem(), settings_from(search));
    EXPECT_EQ(result.verdict, Verdict::kNoSingularity) << x;
    points.push_back({x, static_cast<double>(result.statistics.boxes)});
  }
  return exponent(points).value();
}

TEST(Growth, WithTheToleranceOfRobot2IsSlowerTheMoreTheBoundsSee) {
  const Series& tolerance = kGrowth[3];
  const double before = exponent_without(tolerance, {"second-order"});
  const double fixed = exponent_without(tolerance, {"moving"});
  const double now = exponent_without(tolerance, {});
  EXPECT_GT(before, 3.5);
  EXPECT_LT(fixed, 2);
  EXPECT_LT(now, 1.4);
  EXPECT_LT(now, fixed);
}

}  // namespace
}  // namespace regulus::detail::test
