// SPDX-License-Identifier: GPL-3.0-or-later
// Tests verdicts and budgets of boxes for the six-legged platforms of Table III.
#include <gtest/gtest.h>

#include "runtime/search/solver.hpp"
#include "tests/support/exact.hpp"
#include "tests/support/gough_kernel.hpp"

namespace regulus::detail {
namespace {

using test::GoughKernel;
using test::kRobot1;
using test::kRobot2;

Problem workspace(const GoughKernel& kernel, double xy, Interval z, double degrees) {
  Problem problem;
  problem.kernel = kernel.get();
  const test::Angle angle = test::plus_minus_degrees(degrees);
  const Interval side(-xy, xy);
  problem.outer = {side, side, z, angle.outer, angle.outer, angle.outer};
  problem.inner = {side, side, z, angle.inner, angle.inner, angle.inner};
  return problem;
}

Problem robot_1(const GoughKernel& kernel, double xy, double degrees) {
  return workspace(kernel, xy, {45, 50}, degrees);
}
Problem robot_2(const GoughKernel& kernel, double degrees) {
  return workspace(kernel, 200, {2800, 3200}, degrees);
}

void expect_free(const Result& result, std::uint64_t most_boxes) {
  EXPECT_EQ(result.verdict, Verdict::kNoSingularity) << describe(result.reason);
  EXPECT_LE(result.statistics.boxes, most_boxes);
}

void expect_singular(const Problem& problem, const Result& result, std::uint64_t most_boxes) {
  ASSERT_EQ(result.verdict, Verdict::kSingularity) << describe(result.reason);
  EXPECT_LE(result.statistics.boxes, most_boxes);
  ASSERT_EQ(result.witness->points.size(), 2U);
  EXPECT_GT(result.witness->points[0].determinant.lo, 0);
  EXPECT_LT(result.witness->points[1].determinant.hi, 0);
  for (const WitnessPoint& point : result.witness->points)
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_TRUE(certain_subset(point.variables[k], *problem.inner[k]));
}

TEST(Gough, TableIvIsFreeInOneBox) {
  const GoughKernel kernel(kRobot1);
  for (const double degrees : {1.0, 2.0, 5.0})
    expect_free(solve(robot_1(kernel, 5, degrees), {}), 1);
}

TEST(Gough, Robot1IsFreeWithin15Degrees) {
  const GoughKernel kernel(kRobot1);
  expect_free(solve(robot_1(kernel, 15, 15), {}), 19);
}

TEST(Gough, Robot1IsSingularWithin40Degrees) {
  const GoughKernel kernel(kRobot1);
  const Problem problem = robot_1(kernel, 15, 40);
  expect_singular(problem, solve(problem, {}), 10);
}

TEST(Gough, Robot2IsFreeWithin30Degrees) {
  const GoughKernel kernel(kRobot2);
  expect_free(solve(robot_2(kernel, 20), {}), 27);
  expect_free(solve(robot_2(kernel, 30), {}), 227);
}

TEST(Gough, Robot2IsSingularWithin40Degrees) {
  const GoughKernel kernel(kRobot2);
  const Problem problem = robot_2(kernel, 40);
  expect_singular(problem, solve(problem, {}), 20);
}

TEST(Gough, NaturalBoundsAloneNeedMoreBoxes) {
  GoughKernel kernel(kRobot1);
  const std::uint64_t with_derivatives = solve(robot_1(kernel, 15, 15), {}).statistics.boxes;
  kernel.functions().left_derivatives = nullptr;
  const Result result = solve(robot_1(kernel, 15, 15), {});
  expect_free(result, 2 * 19);
  EXPECT_GT(result.statistics.boxes, with_derivatives);
}

TEST(Gough, TheNumberOfBoxesThatProveFreedomDoesNotDependOnTheBatch) {
  const GoughKernel kernel(kRobot2);
  Settings one;
  one.batch = 1;
  EXPECT_EQ(solve(robot_2(kernel, 20), one).statistics.boxes,
            solve(robot_2(kernel, 20), {}).statistics.boxes);
}

TEST(Gough, EveryMethodOfThePaperCertifiesASmallWorkspace) {
  const GoughKernel kernel(kRobot1);
  for (const Method method : {Method::kRegRohn, Method::kKj, Method::kKjRohn, Method::kJk,
                              Method::kJkRohn, Method::kKjNumeric, Method::kJkNumeric}) {
    Settings settings;
    settings.method = method;
    settings.bisection = Bisection::kWeighted;
    const Result result = solve(workspace(kernel, 0.25, {46.75, 47.25}, 0.25), settings);
    EXPECT_EQ(result.verdict, Verdict::kNoSingularity) << name(method);
  }
}

TEST(Gough, EveryMethodOfThePaperFindsTheSingularity) {
  const GoughKernel kernel(kRobot1);
  const Problem problem = robot_1(kernel, 15, 40);
  for (const Method method :
       {Method::kReg, Method::kRegRohn, Method::kKj, Method::kJk, Method::kKjNumeric}) {
    Settings settings;
    settings.method = method;
    expect_singular(problem, solve(problem, settings), 10);
  }
}

/// det J⁻¹ over the workspace is far above this; its row scales are 1/ρᵢ ≈ 1/50.
TEST(Gough, ThresholdsAreOnTheDeterminantOfTheScaledMatrix) {
  const GoughKernel kernel(kRobot1);
  Problem problem = robot_1(kernel, 5, 5);
  Settings settings;
  settings.max_boxes = 20000;
  problem.alpha = Interval(1.0);
  EXPECT_EQ(solve(problem, settings).verdict, Verdict::kNoSingularity);
  problem.alpha = Interval(1e6);
  const Result result = solve(problem, settings);
  ASSERT_EQ(result.verdict, Verdict::kSingularity);
  EXPECT_EQ(result.reason, Reason::kSmallDeterminant);
  ASSERT_EQ(result.witness->points.size(), 1U);
  EXPECT_LE(mag(result.witness->points[0].determinant), 1e6);
}

}  // namespace
}  // namespace regulus::detail
