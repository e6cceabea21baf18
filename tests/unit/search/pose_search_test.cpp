// SPDX-License-Identifier: GPL-3.0-or-later
// Tests whether the constraints leave any pose, and the answer of the search then.
#include "runtime/witness/pose_search.hpp"

#include <gtest/gtest.h>

#include "runtime/search/paving.hpp"
#include "tests/support/function_kernel.hpp"

namespace regulus::detail {
namespace {

using test::FunctionKernel;
using test::problem_over;
using test::Values;

/// Is regular everywhere.
Values two(const Values&) { return Values{Interval(2.0)}; }

Interval square_of_radius(const Values& x) { return sqr(x[0]) + sqr(x[1]); }

struct Constrained {
  Constrained(unsigned count, FunctionKernel::Function constraint)
      : kernel(2, 1, 1, two), problem() {
    kernel.with_constraints(count, std::move(constraint));
    problem = problem_over(kernel, {{-2, 3}, {-2, 3}});
  }
  Result searched(const Settings& settings = {}) const { return solve(problem, settings); }

  FunctionKernel kernel;
  Problem problem;
};

void expect_empty(const Result& result) {
  EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
  EXPECT_EQ(result.reason, Reason::kEmptyVariety);
  EXPECT_EQ(result.occupancy, Occupancy::kEmpty);
  EXPECT_FALSE(result.witness);
  EXPECT_TRUE(result.blocking_box.empty());
}

TEST(PoseSearch, NothingIsClaimedOfAVarietyThatTheConstraintsExclude) {
  const Constrained positive(1, [](const Values& x) { return Values{sqr(x[0]) + 1.0}; });
  expect_empty(positive.searched());
  for (const Uncertainty uncertainty : {Uncertainty::kElements, Uncertainty::kVariables}) {
    Settings settings;
    settings.uncertainty = uncertainty;
    expect_empty(positive.searched(settings));
  }
  Settings exhaustive;
  exhaustive.exhaustive = true;
  expect_empty(positive.searched(exhaustive));
}

/// No box needs a split to be certified, so the search finds no box outside.
TEST(PoseSearch, SeesThatTwoConstraintsExcludeEachOther) {
  const Constrained apart(2, [](const Values& x) {
    return Values{x[0] - 1.0, 1.0 + 0x1p-40 - x[0]};
  });
  const Result result = apart.searched();
  EXPECT_EQ(result.statistics.leaves[std::size_t(Rule::kOutside)], 0U);
  expect_empty(result);
}

TEST(PoseSearch, FindsTheOnePoseThatConstraintsLeave) {
  const Constrained touching(2, [](const Values& x) { return Values{x[0] - 0.7, 0.7 - x[0]}; });
  const Result edge = touching.searched();
  EXPECT_EQ(edge.verdict, Verdict::kNoSingularity);
  EXPECT_EQ(edge.occupancy, Occupancy::kInhabited);
  ASSERT_EQ(edge.inhabitant.size(), 2U);
  EXPECT_EQ(edge.inhabitant[0], Interval(0.7));
  const Constrained origin(1, [](const Values& x) { return Values{square_of_radius(x)}; });
  const Result middle = origin.searched();
  EXPECT_EQ(middle.occupancy, Occupancy::kInhabited);
  EXPECT_EQ(middle.inhabitant[0], Interval(0.0));
  const Constrained corner(1, [](const Values& x) { return Values{3.0 - x[0] + (3.0 - x[1])}; });
  EXPECT_EQ(corner.searched().occupancy, Occupancy::kInhabited);
}

/// A circle of radius √2 about this point contains no pair of doubles, but it is not empty. The
/// claim is true, but the search does not know whether any pose is left.
TEST(PoseSearch, KeepsAClaimOfWhichItIsNotKnownWhetherItSpeaksOfAnyPose) {
  const Interval third = Interval(1.0) / Interval(3.0);
  const Constrained circle(2, [third](const Values& x) {
    const Interval r = sqr(x[0] - third) + sqr(x[1] - third) - 2.0;
    return Values{r, -r};
  });
  const Result result = circle.searched();
  EXPECT_EQ(result.verdict, Verdict::kNoSingularity);
  EXPECT_EQ(result.occupancy, Occupancy::kUnknown);
  EXPECT_TRUE(result.inhabitant.empty());
}

TEST(PoseSearch, AConstraintThatIsUndefinedExcludesNothing) {
  const Constrained undefined(1, [](const Values&) { return Values{kEntire}; });
  const Result result = undefined.searched();
  EXPECT_EQ(result.occupancy, Occupancy::kUnknown);
  EXPECT_NE(result.reason, Reason::kEmptyVariety);
}

/// If only part of the ranges is undefined, the search uses the rest.
TEST(PoseSearch, LooksWhereAConstraintIsDefined) {
  const Constrained partly(1, [](const Values& x) {
    return Values{x[0].lo > 0.0 ? Interval(1.0) / x[0] - 1.0 : kEntire};
  });
  EXPECT_EQ(partly.searched().occupancy, Occupancy::kInhabited);
}

TEST(PoseSearch, WithoutConstraintsThereIsAlwaysAPose) {
  const FunctionKernel kernel(1, 1, 1, two);
  EXPECT_EQ(solve(problem_over(kernel, {{0, 1}}), {}).occupancy, Occupancy::kInhabited);
}

/// The true range is one value that is not a double: the point is its whole enclosure.
TEST(PoseSearch, APointInARangeWithoutDoublesIsTheWholeRange) {
  Constrained inside(1, [](const Values& x) { return Values{x[0] - 1.0}; });
  inside.problem.outer[0] = {0.25, 0.25 + 0x1p-54};
  inside.problem.inner[0].reset();
  const Result result = inside.searched();
  ASSERT_EQ(result.occupancy, Occupancy::kInhabited);
  EXPECT_EQ(result.inhabitant[0], inside.problem.outer[0]);
}

TEST(PoseSearch, ABudgetThatEndsTheSearchLeavesItUnknown) {
  FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{x[0] * x[0] - x[0] + 1.0}; });
  kernel.with_constraints(1, [](const Values& x) { return Values{x[0] - 1.0}; });
  Settings settings;
  settings.max_boxes = 1;
  const Result result = solve(problem_over(kernel, {{-8, 8}}), settings);
  EXPECT_EQ(result.reason, Reason::kBoxBudget);
  EXPECT_EQ(result.occupancy, Occupancy::kUnknown);
}

class SaysItVanishes final : public AlgebraOracle {
 public:
  explicit SaysItVanishes(Determinant answer) : answer_(answer) {}
  Determinant determinant(std::span<const Interval> point) noexcept override {
    ++asked;
    asked_at.assign(point.begin(), point.end());
    return answer_;
  }
  int asked = 0;
  std::vector<Interval> asked_at;

 private:
  Determinant answer_;
};

/// Returns rows with det = x·y − y·x; the enclosure does not know that both products are equal.
Values dependent_rows(const Values& x) { return {x[0], x[1], x[0], x[1]}; }

struct Dependent {
  explicit Dependent(double largest) : kernel(2, 2, 2, dependent_rows) {
    kernel.with_constraints(1, [largest](const Values& x) { return Values{x[0] - largest}; });
    problem = problem_over(kernel, {{0.3, 1.1}, {0.2, 1.3}});
    settings.max_boxes = 200;
  }
  FunctionKernel kernel;
  Problem problem;
  Settings settings;
};

TEST(AlgebraInASearch, SingularEverywhereNeedsAPoseInsideTheConstraints) {
  SaysItVanishes algebra(AlgebraOracle::Determinant::kVanishes);
  Dependent some(0.4);
  some.settings.algebra = &algebra;
  some.settings.ingredients.midpoints = some.settings.ingredients.descents = false;
  const Result result = solve(some.problem, some.settings);
  ASSERT_EQ(result.reason, Reason::kAlwaysSingular) << describe(result.reason);
  EXPECT_EQ(result.verdict, Verdict::kSingularity);
  EXPECT_EQ(algebra.asked, 1);
  EXPECT_EQ(result.witness->points.front().variables, algebra.asked_at);
  EXPECT_LE(algebra.asked_at[0].hi, 0.4);
  EXPECT_EQ(result.witness->points.front().pose.size(), 2U);
  EXPECT_EQ(result.occupancy, Occupancy::kInhabited);
  Dependent none(0.2);
  none.settings.algebra = &algebra;
  expect_empty(solve(none.problem, none.settings));
  EXPECT_EQ(algebra.asked, 1);
}

TEST(AlgebraInASearch, IsNotAskedWhereABoxWasCertified) {
  SaysItVanishes algebra(AlgebraOracle::Determinant::kVanishes);
  const FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{sqr(x[0] - 0.3)}; });
  Settings settings;
  settings.algebra = &algebra;
  settings.ingredients.descents = settings.ingredients.midpoints = false;
  const Result result = solve(problem_over(kernel, {{-1, 1}}), settings);
  EXPECT_NE(result.reason, Reason::kAlwaysSingular);
  EXPECT_EQ(algebra.asked, 0);
}

TEST(AlgebraInASearch, IsNotAskedAboutWhatIsUndefinedEverywhere) {
  SaysItVanishes algebra(AlgebraOracle::Determinant::kVanishes);
  const FunctionKernel kernel(1, 1, 1, [](const Values&) { return Values{kEntire}; });
  Settings settings;
  settings.algebra = &algebra;
  const Result result = solve(problem_over(kernel, {{-1, 1}}), settings);
  EXPECT_EQ(result.reason, Reason::kUndefined);
  EXPECT_EQ(algebra.asked, 0);
}

TEST(AlgebraInASearch, WhatOnlySeemsToVanishProvesNothing) {
  SaysItVanishes algebra(AlgebraOracle::Determinant::kSeemsToVanish);
  Dependent some(2);
  some.settings.algebra = &algebra;
  some.settings.max_boxes = std::numeric_limits<std::uint64_t>::max();
  some.settings.min_relative_width = 0x1p-6;
  some.settings.ingredients.midpoints = some.settings.ingredients.descents = false;
  const Result result = solve(some.problem, some.settings);
  EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
  EXPECT_EQ(result.reason, Reason::kSeemsSingular);
  EXPECT_FALSE(result.witness);
  EXPECT_FALSE(result.blocking_box.empty());
}

}  // namespace
}  // namespace regulus::detail
