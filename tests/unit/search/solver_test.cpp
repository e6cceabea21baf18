// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the meaning of each verdict, on matrices whose singularities are known.
#include "runtime/search/solver.hpp"

#include <gtest/gtest.h>

#include "tests/support/function_kernel.hpp"

namespace regulus::detail {
namespace {

using test::FunctionKernel;
using test::problem_over;
using test::Values;

const Interval kOneThird = Interval(1.0) / Interval(3.0);

Settings with_method(Method method) {
  Settings settings;
  settings.method = method;
  return settings;
}

TEST(Solver, CertifiesARegularMatrix) {
  const FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{x[0] + 2.0}; });
  const Result result = solve(problem_over(kernel, {{-1, 1}}), {});
  EXPECT_EQ(result.verdict, Verdict::kNoSingularity);
  EXPECT_EQ(result.reason, Reason::kAllBoxesCertified);
  EXPECT_EQ(result.statistics.boxes, 1U);
  EXPECT_EQ(result.statistics.max_frontier, 1U);
  EXPECT_TRUE(result.blocking_box.empty());
  EXPECT_FALSE(result.witness);
}

TEST(Solver, ProvesASingularityByOppositeSignsAndClosesIn) {
  const FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{x[0] - kOneThird}; });
  const Result result = solve(problem_over(kernel, {{-1, 1}}), {});
  ASSERT_EQ(result.verdict, Verdict::kSingularity);
  EXPECT_EQ(result.reason, Reason::kOppositeSigns);
  const Witness& witness = *result.witness;
  ASSERT_EQ(witness.points.size(), 2U);
  EXPECT_GT(witness.points[0].determinant.lo, 0);
  EXPECT_LT(witness.points[1].determinant.hi, 0);
  EXPECT_GT(witness.points[0].variables[0].lo, kOneThird.lo);
  EXPECT_LT(witness.points[1].variables[0].hi, kOneThird.hi);
  ASSERT_TRUE(witness.near);
  EXPECT_NEAR(witness.near->variables[0].lo, 1.0 / 3, 1e-15);
  EXPECT_EQ(witness.near->pose.size(), 1U);
  for (const WitnessPoint& point : witness.points)
    EXPECT_LE(mag(witness.near->determinant), mag(point.determinant));
}

TEST(Solver, ClosesInFromBothSidesOnAPointWhoseSignCannotBeTold) {
  const Interval noise(-1e-6, 1e-6);
  const FunctionKernel kernel(1, 1, 1, [&](const Values& x) { return Values{x[0] + noise}; });
  const Result result = solve(problem_over(kernel, {{-1, 1}}), {});
  ASSERT_EQ(result.reason, Reason::kOppositeSigns);
  for (const WitnessPoint& point : result.witness->points)
    EXPECT_LE(mag(point.variables[0]), 2.1e-6);
  ASSERT_TRUE(result.witness->near);
  EXPECT_EQ(result.witness->near->variables[0], Interval(0.0));
  EXPECT_TRUE(contains(result.witness->near->determinant, 0.0));
}

TEST(Solver, ProvesASingularityAtAPointOfDeterminantZero) {
  const FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{sqr(x[0])}; });
  const Result result = solve(problem_over(kernel, {{-1, 1}}), {});
  ASSERT_EQ(result.verdict, Verdict::kSingularity);
  EXPECT_EQ(result.reason, Reason::kSmallDeterminant);
  ASSERT_EQ(result.witness->points.size(), 1U);
  EXPECT_EQ(result.witness->points[0].determinant, Interval(0.0));
  ASSERT_TRUE(result.witness->near);
  EXPECT_EQ(result.witness->near->variables, result.witness->points[0].variables);
}

TEST(Solver, DoesNotDecideAZeroThatIsTouched) {
  const FunctionKernel kernel(1, 1, 1,
                              [](const Values& x) { return Values{sqr(x[0] - kOneThird)}; });
  const Result result = solve(problem_over(kernel, {{-1, 1}}), {});
  EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
  EXPECT_EQ(result.reason, Reason::kWidth);
  ASSERT_EQ(result.blocking_box.size(), 1U);
  EXPECT_TRUE(certain_subset(kOneThird, result.blocking_box[0]) ||
              std::abs(mid(result.blocking_box[0]) - 1.0 / 3) < 1e-6);
}

TEST(Solver, ASignChangeAcrossAPoleIsNoSingularity) {
  const FunctionKernel kernel(1, 1, 1,
                              [](const Values& x) { return Values{1.0 / (x[0] - kOneThird)}; });
  const Result result = solve(problem_over(kernel, {{-1, 1}}), {});
  EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
  EXPECT_EQ(result.reason, Reason::kUndefined);
}

TEST(Solver, AnUndefinedPartOfTheVarietyIsNeverSafe) {
  const FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{sqrt(x[0]) + 1.0}; });
  EXPECT_EQ(solve(problem_over(kernel, {{0, 1}}), {}).verdict, Verdict::kNoSingularity);
  const Result result = solve(problem_over(kernel, {{-0.25, 1}}), {});
  EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
  EXPECT_EQ(result.reason, Reason::kUndefined);
  EXPECT_LT(result.blocking_box[0].lo, 0);
  EXPECT_LT(result.statistics.boxes, 100U);
}

TEST(Solver, AnUndefinedRowScaleIsNeverSafe) {
  FunctionKernel kernel(1, 1, 1, [](const Values&) { return Values{1.0}; });
  kernel.with_row_scale([](const Values& x) { return Values{1.0 / sqr(x[0])}; });
  EXPECT_EQ(solve(problem_over(kernel, {{1, 2}}), {}).verdict, Verdict::kNoSingularity);
  const Result result = solve(problem_over(kernel, {{-1, 1}}), {});
  EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
  EXPECT_EQ(result.reason, Reason::kUndefined);
}

TEST(Solver, ARowScaleThatMayVanishIsNeverSafe) {
  FunctionKernel kernel(1, 1, 1, [](const Values&) { return Values{1.0}; });
  kernel.with_row_scale([](const Values& x) { return Values{x[0]}; });
  EXPECT_NE(solve(problem_over(kernel, {{0, 1}}), {}).verdict, Verdict::kNoSingularity);
}

TEST(Solver, AnUndefinedPoseIsNeverSafe) {
  FunctionKernel kernel(1, 1, 1, [](const Values&) { return Values{1.0}; });
  kernel.with_pose(1, [](const Values& x) { return Values{sqrt(x[0])}; });
  EXPECT_EQ(solve(problem_over(kernel, {{0, 1}}), {}).verdict, Verdict::kNoSingularity);
  EXPECT_EQ(solve(problem_over(kernel, {{-1, 1}}), {}).verdict, Verdict::kPossibleProblem);
}

// Constraints.

TEST(Solver, ConstraintsRemoveTheSingularPart) {
  FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{x[0]}; });
  kernel.with_constraints(1, [](const Values& x) { return Values{0.5 - sqr(x[0])}; });
  // Opposite signs at the two ends, in different components, are not a singularity.
  const Result result = solve(problem_over(kernel, {{-1, 1}}), {});
  EXPECT_EQ(result.verdict, Verdict::kNoSingularity);
  EXPECT_GT(result.statistics.leaves[static_cast<std::size_t>(Rule::kOutside)], 0U);
}

TEST(Solver, ClaimsNothingOfAnEmptyVariety) {
  FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{x[0]}; });
  kernel.with_constraints(1, [](const Values& x) { return Values{sqr(x[0]) + 1.0}; });
  const Result result = solve(problem_over(kernel, {{-1, 1}}), {});
  EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
  EXPECT_EQ(result.reason, Reason::kEmptyVariety);
}

TEST(Solver, FindsASingularityInsideConstraints) {
  FunctionKernel kernel(2, 1, 1, [](const Values& x) { return Values{x[0] - x[1] - kOneThird}; });
  const auto disc = [](const Values& x) { return Values{sqr(x[0]) + sqr(x[1]) - 1.0}; };
  kernel.with_constraints(1, disc);
  const Result result = solve(problem_over(kernel, {{-1, 1}, {-1, 1}}), {});
  ASSERT_EQ(result.verdict, Verdict::kSingularity);
  for (const WitnessPoint& point : result.witness->points)
    EXPECT_LE(disc(point.variables)[0].hi, 0);
}

TEST(Solver, FindsASingularityInOneArmOfABentVariety) {
  // An L: the straight line between the corners leaves it, but det vanishes within one arm.
  FunctionKernel kernel(2, 1, 1, [](const Values& x) { return Values{x[1] - 0.7}; });
  const auto inside = [](const Values& x) {
    return Values{(x[0] - 0.25) * (x[1] - 0.25) - abs(x[0] - 0.25) * abs(x[1] - 0.25) * 0.5 -
                  0.001 + Interval(0.0) * x[0]};
  };
  kernel.with_constraints(1, inside);
  const Result result = solve(problem_over(kernel, {{0, 1}, {0, 1}}), {});
  ASSERT_EQ(result.verdict, Verdict::kSingularity);
  for (const WitnessPoint& point : result.witness->points)
    EXPECT_LE(inside(point.variables)[0].hi, 0);
}

TEST(Solver, NeverClaimsASingularityOutsideTheConstraints) {
  // det = x vanishes on x = 0 only, which the constraint 2^-20 − x² ≤ 0 just excludes.
  FunctionKernel kernel(2, 1, 1, [](const Values& x) { return Values{x[0]}; });
  kernel.with_constraints(1, [](const Values& x) { return Values{0x1p-20 - sqr(x[0])}; });
  EXPECT_EQ(solve(problem_over(kernel, {{-1, 1}, {-1, 1}}), {}).verdict, Verdict::kNoSingularity);
}

TEST(Solver, AnUndefinedConstraintExcludesNothing) {
  FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{x[0] - kOneThird}; });
  kernel.with_constraints(1, [](const Values& x) { return Values{sqrt(x[0] - 2.0)}; });
  EXPECT_EQ(solve(problem_over(kernel, {{-1, 1}}), {}).verdict, Verdict::kPossibleProblem);
}

// Thresholds.

TEST(Solver, ThresholdsAreStrict) {
  const FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{x[0]}; });
  EXPECT_EQ(solve(problem_over(kernel, {{2, 3}}, 1.5), {}).verdict, Verdict::kNoSingularity);
  // |det| > 2 fails at x = 2 itself; a lower bound that equals α must not cause a loop.
  const Result at = solve(problem_over(kernel, {{2, 3}}, 2.0), {});
  ASSERT_EQ(at.verdict, Verdict::kSingularity);
  EXPECT_EQ(at.reason, Reason::kSmallDeterminant);
  EXPECT_EQ(at.witness->points[0].variables[0], Interval(2.0));
  EXPECT_EQ(solve(problem_over(kernel, {{2, 3}}, 2.5), {}).verdict, Verdict::kSingularity);
}

TEST(Solver, ALowerBoundEqualToTheThresholdIsNotAbove) {
  // The interval determinant over the whole box is exactly [2, 3].
  const FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{x[0]}; });
  EXPECT_EQ(solve(problem_over(kernel, {{2, 3}}, 2.0), with_method(Method::kReg)).verdict,
            Verdict::kSingularity);
}

TEST(Solver, AThresholdBetweenDoublesIsNotDecidedWithinItsEnclosure) {
  const FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{x[0]}; });
  const Interval alpha(1.0, 1.0 + 0x1p-20);
  EXPECT_EQ(solve(problem_over(kernel, {{1.0 + 0x1p-21, 2}}, alpha), {}).verdict,
            Verdict::kPossibleProblem);
  EXPECT_EQ(solve(problem_over(kernel, {{1.0 + 0x1p-19, 2}}, alpha), {}).verdict,
            Verdict::kNoSingularity);
}

TEST(Solver, ThresholdsIncludeTheRowScale) {
  FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{sqr(x[0])}; });
  kernel.with_row_scale([](const Values& x) { return Values{1.0 / x[0]}; });
  Settings settings;
  settings.max_boxes = 10000;
  EXPECT_EQ(solve(problem_over(kernel, {{2, 3}}, 1.5), settings).verdict, Verdict::kNoSingularity);
  const Result result = solve(problem_over(kernel, {{2, 3}}, 2.5), settings);
  ASSERT_EQ(result.verdict, Verdict::kSingularity);
  EXPECT_LE(mag(result.witness->points[0].determinant), 2.5);
  EXPECT_LE(result.witness->points[0].variables[0].hi, 2.5);
}

TEST(Solver, EveryMethodHonoursThresholds) {
  const FunctionKernel kernel(2, 2, 2, [](const Values& x) {
    return Values{x[0], 0.25 * x[1], -0.25 * x[1], x[0]};
  });
  for (const Method method :
       {Method::kAuto, Method::kReg, Method::kRegRohn, Method::kKj, Method::kKjRohn, Method::kJk,
        Method::kJkRohn, Method::kKjNumeric, Method::kJkNumeric}) {
    Settings settings = with_method(method);
    settings.max_boxes = 20000;
    // det = x² + y²/16 ≥ 4.
    const auto verdict = [&](double alpha) {
      return solve(problem_over(kernel, {{2, 3}, {-1, 1}}, alpha), settings).verdict;
    };
    EXPECT_EQ(verdict(0.0), Verdict::kNoSingularity) << name(method);
    EXPECT_EQ(verdict(3.9), Verdict::kNoSingularity) << name(method);
    EXPECT_EQ(verdict(4.1), Verdict::kSingularity) << name(method);
  }
}

TEST(Solver, APointOfSmallDeterminantMustLieInTheVariety) {
  // Only x ≤ 0.6 is in the variety, and witnesses need x ≥ 0.75: every midpoint is moved outside.
  FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{x[0]}; });
  kernel.with_constraints(1, [](const Values& x) { return Values{x[0] - 0.6}; });
  Problem problem = problem_over(kernel, {{0, 1}}, 10.0);
  problem.inner[0] = Interval(0.75, 1);
  EXPECT_EQ(solve(problem, {}).verdict, Verdict::kPossibleProblem);
}

// Uncertain quantities.

TEST(Solver, TheClaimIsForEveryUncertainValue) {
  FunctionKernel kernel(2, 1, 1, [](const Values& x) { return Values{x[0] + x[1]}; });
  kernel.with_uncertain(1);
  EXPECT_EQ(solve(problem_over(kernel, {{1, 2}, {-0.5, 0.5}}), {}).verdict,
            Verdict::kNoSingularity);
  const Result result = solve(problem_over(kernel, {{1, 2}, {-1.125, 1.125}}), {});
  ASSERT_EQ(result.verdict, Verdict::kSingularity);
  EXPECT_LT(result.witness->points[1].variables[1].hi, -0.99);
}

TEST(Solver, SaysWhenTheUncertaintyAloneDefeatsTheTest) {
  FunctionKernel kernel(2, 1, 1, [](const Values& x) { return Values{x[0] + x[1] - x[1]}; });
  kernel.with_uncertain(1);
  const Problem problem = problem_over(kernel, {{1, 2}, {-1, 1}});
  const Result elements = solve(problem, {});
  EXPECT_EQ(elements.verdict, Verdict::kPossibleProblem);
  EXPECT_EQ(elements.reason, Reason::kUncertainty);
  EXPECT_EQ(elements.blocking_box.size(), 2U);
  Settings settings;
  settings.uncertainty = Uncertainty::kVariables;
  EXPECT_EQ(solve(problem, settings).verdict, Verdict::kNoSingularity);
}

// Ranges that are not doubles.

TEST(Solver, AWitnessLiesInTheInnerRange) {
  const FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{x[0]}; });
  Problem problem = problem_over(kernel, {{-0.25, 1}});
  // det vanishes at 0, which may or may not belong to the true range.
  problem.inner[0] = Interval(0.25, 1);
  const Result outside = solve(problem, {});
  EXPECT_EQ(outside.verdict, Verdict::kPossibleProblem);
  problem.inner[0] = Interval(-0.125, 1);
  const Result inside = solve(problem, {});
  ASSERT_EQ(inside.verdict, Verdict::kSingularity);
  for (const WitnessPoint& point : inside.witness->points)
    EXPECT_TRUE(certain_subset(point.variables[0], *problem.inner[0]));
}

TEST(Solver, AVariableWithoutAnInnerRangeIsKeptWholeInWitnesses) {
  const FunctionKernel kernel(2, 1, 1, [](const Values& x) { return Values{x[0] * x[1]}; });
  Problem problem = problem_over(kernel, {{-1, 1}, {3.0, 3.0 + 0x1p-51}});
  problem.inner[1] = std::nullopt;
  const Result result = solve(problem, {});
  ASSERT_EQ(result.verdict, Verdict::kSingularity);
  for (const WitnessPoint& point : result.witness->points)
    EXPECT_EQ(point.variables[1], problem.outer[1]);
}

// Tall matrices.

TEST(Solver, CertifiesFullColumnRankOfTallMatrices) {
  const FunctionKernel kernel(1, 2, 1, [](const Values& x) { return Values{x[0], 1.0 - x[0]}; });
  EXPECT_EQ(solve(problem_over(kernel, {{-1, 1}}), {}).verdict, Verdict::kNoSingularity);
}

TEST(Solver, NeverClaimsASingularityOfATallMatrix) {
  const FunctionKernel kernel(1, 2, 1, [](const Values& x) { return Values{x[0], x[0]}; });
  const Result result = solve(problem_over(kernel, {{-1, 1}}), {});
  EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
}

TEST(Solver, CertifiesARedundantMatrixWhoseSquarePartsAreSingular) {
  // Any two rows become dependent somewhere; all three never do.
  const FunctionKernel kernel(
      1, 3, 2, [](const Values& x) { return Values{cos(x[0]), sin(x[0]), 1.0, 0.0, 0.0, 1.0}; });
  EXPECT_EQ(solve(problem_over(kernel, {{-4, 4}}), {}).verdict, Verdict::kNoSingularity);
}

// Points.

TEST(Solver, DecidesAVarietyOfOnePoint) {
  const FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{x[0]}; });
  EXPECT_EQ(solve(problem_over(kernel, {2.0}), {}).verdict, Verdict::kNoSingularity);
  EXPECT_EQ(solve(problem_over(kernel, {0.0}), {}).verdict, Verdict::kSingularity);
}

TEST(Solver, AsksTheOracleWhereDoublesCannotTell) {
  class Oracle final : public DeterminantOracle {
   public:
    std::optional<Interval> enclose(std::span<const Interval> point) noexcept override {
      ++calls;
      return point[0] - kOneThird.lo;
    }
    int calls = 0;
  };
  // This enclosure is too wide to have a sign: only the oracle knows it.
  const FunctionKernel kernel(
      1, 1, 1, [](const Values& x) { return Values{x[0] - kOneThird + Interval(-4, 4)}; });
  EXPECT_EQ(solve(problem_over(kernel, {{-1, 1}}), {}).verdict, Verdict::kPossibleProblem);
  Oracle oracle;
  Settings settings;
  settings.oracle = &oracle;
  const Result result = solve(problem_over(kernel, {{-1, 1}}), settings);
  EXPECT_EQ(result.verdict, Verdict::kSingularity);
  EXPECT_GT(oracle.calls, 1);
}

}  // namespace
}  // namespace regulus::detail
