// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the claim of an exhaustive search about each box, and the sums of the volumes.
#include "runtime/search/paving.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "tests/support/function_kernel.hpp"

namespace regulus::detail {
namespace {

using test::FunctionKernel;
using test::problem_over;
using test::Values;

struct Leaf {
  std::vector<Interval> box;
  Claim claim;
  Reason reason;
  std::vector<WitnessPoint> points;
  std::optional<Interval> determinant;
};

class Collector : public Observer {
 public:
  explicit Collector(const Problem& problem) : volumes(problem) {}
  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override {
    Leaf leaf{
        {box.box.begin(), box.box.end()}, claim_of(rule), proof.reason, {}, proof.determinant};
    if (proof.witness != nullptr) leaf.points = proof.witness->points;
    volumes.on_leaf(box, rule, proof);
    leaves.push_back(leaf);
  }
  void on_open(const OpenBox& box) noexcept override {
    volumes.on_open(box);
    ++open;
  }

  Volumes volumes;
  std::vector<Leaf> leaves;
  std::uint64_t open = 0;
};

Settings exhaustive(double resolution) {
  Settings settings;
  settings.exhaustive = true;
  settings.min_relative_width = resolution;
  return settings;
}

Interval sum_of_claims(const Volumes& volumes) {
  Interval sum(0.0);
  for (const Claim claim : {Claim::kFree, Claim::kSingular, Claim::kUndecided, Claim::kOutside})
    sum += volumes.of(claim).volume;
  return sum;
}

/// Makes det = x² + y² − 1 as a 2×2 matrix.
FunctionKernel circle() {
  return FunctionKernel(2, 2, 2, [](const Values& x) {
    return Values{x[0], x[1] + 1.0, 1.0 - x[1], x[0]};
  });
}
const std::vector<Interval> kSquare{{-2, 2}, {-2, 2}};

bool meets_circle(const std::vector<Interval>& box) {
  const Interval square = sqr(box[0]) + sqr(box[1]);
  return contains(square, 1.0);
}

TEST(Paving, SeparatesACircleFromWhatIsFree) {
  const FunctionKernel kernel = circle();
  const Problem problem = problem_over(kernel, kSquare);
  Collector paving(problem);
  const Result result = solve(problem, exhaustive(0x1p-5), &paving);
  EXPECT_EQ(result.verdict, Verdict::kSingularity);
  for (const Leaf& leaf : paving.leaves) {
    if (leaf.claim == Claim::kUndecided) continue;
    EXPECT_EQ(leaf.claim == Claim::kSingular, meets_circle(leaf.box));
  }
  EXPECT_GT(paving.volumes.of(Claim::kSingular).boxes, 40U);
  EXPECT_EQ(sum_of_claims(paving.volumes), Interval(16.0));
  EXPECT_GT(paving.volumes.of(Claim::kFree).volume.lo, 13.0);
}

TEST(Paving, ShowsEverySingularBoxBySignsWithinIt) {
  const FunctionKernel kernel = circle();
  const Problem problem = problem_over(kernel, kSquare);
  Collector paving(problem);
  static_cast<void>(solve(problem, exhaustive(0x1p-4), &paving));
  for (const Leaf& leaf : paving.leaves) {
    if (leaf.claim != Claim::kSingular) continue;
    for (const WitnessPoint& point : leaf.points)
      for (std::size_t k = 0; k < 2; ++k)
        EXPECT_TRUE(certain_subset(point.variables[k], leaf.box[k]));
    if (leaf.reason == Reason::kSmallDeterminant) {
      ASSERT_EQ(leaf.points.size(), 1U);
      EXPECT_EQ(leaf.points[0].determinant, Interval(0.0));
    } else {
      ASSERT_EQ(leaf.points.size(), 2U);
      EXPECT_GT(leaf.points[0].determinant.lo, 0.0);
      EXPECT_LT(leaf.points[1].determinant.hi, 0.0);
    }
  }
}

TEST(Paving, LeavesUndecidedAZeroThatIsTouched) {
  const Interval third = Interval(1.0) / Interval(3.0);
  const FunctionKernel kernel(1, 1, 1, [&](const Values& x) { return Values{sqr(x[0] - third)}; });
  const Problem problem = problem_over(kernel, {{-1, 1}});
  Collector paving(problem);
  const Result result = solve(problem, exhaustive(0x1p-6), &paving);
  EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
  EXPECT_EQ(paving.volumes.of(Claim::kSingular).boxes, 0U);
  for (const Leaf& leaf : paving.leaves) {
    if (contains(leaf.box[0], 1.0 / 3)) {
      EXPECT_EQ(leaf.claim, Claim::kUndecided);
    } else if (certain_disjoint(leaf.box[0], {0.25, 0.4})) {
      EXPECT_EQ(leaf.claim, Claim::kFree);
    }
  }
}

TEST(Paving, LeavesABoxWholeWhoseDeterminantIsAtMostAlphaThroughout) {
  const FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{x[0]}; });
  const Problem problem = problem_over(kernel, {{0, 4}}, Interval(1.0));
  Collector paving(problem);
  static_cast<void>(solve(problem, exhaustive(0x1p-10), &paving));
  ASSERT_EQ(paving.volumes.of(Claim::kSingular).boxes, 2U);
  for (const Leaf& leaf : paving.leaves) {
    if (leaf.claim != Claim::kSingular) continue;
    // These are all of [0, 1], and the box just above 1 because of its lower end.
    const bool whole = leaf.box[0] == Interval(0, 1);
    EXPECT_TRUE(whole || leaf.box[0] == Interval(1, 1 + 0x1p-8)) << leaf.box[0].hi;
    EXPECT_EQ(leaf.points[0].variables[0], whole ? leaf.box[0] : Interval(1.0));
  }
  EXPECT_EQ(paving.volumes.of(Claim::kUndecided).boxes, 0U);
}

TEST(Paving, FindsASingularityInABoxForSomeUncertainValueOnly) {
  FunctionKernel kernel(2, 1, 1, [](const Values& x) { return Values{x[0] - x[1]}; });
  kernel.with_uncertain(1);
  const Problem problem = problem_over(kernel, {{0, 1}, {0.4, 0.6}});
  Collector paving(problem);
  static_cast<void>(solve(problem, exhaustive(0x1p-5), &paving));
  for (const Leaf& leaf : paving.leaves) {
    const bool meets = !certain_disjoint(leaf.box[0], {0.4, 0.6});
    EXPECT_EQ(leaf.claim == Claim::kFree, !meets) << leaf.box[0].lo;
    EXPECT_EQ(leaf.box[1], Interval(0.4, 0.6));
  }
  EXPECT_GT(paving.volumes.of(Claim::kSingular).volume.lo, 0.19);
}

TEST(Paving, ListsWhatConstraintsExclude) {
  FunctionKernel kernel = FunctionKernel(1, 1, 1, [](const Values& x) { return Values{x[0]}; });
  kernel.with_constraints(1, [](const Values& x) { return Values{x[0] + 0.25}; });
  const Problem problem = problem_over(kernel, {{-1, 1}});
  Collector paving(problem);
  const Result result = solve(problem, exhaustive(0x1p-4), &paving);
  EXPECT_EQ(result.verdict, Verdict::kNoSingularity);  // the zero, 0, is not in the variety
  EXPECT_EQ(paving.volumes.of(Claim::kSingular).boxes, 0U);
  EXPECT_GT(paving.volumes.of(Claim::kOutside).volume.lo, 1.0);
  EXPECT_EQ(sum_of_claims(paving.volumes), Interval(2.0));
}

TEST(Paving, SplitsWhatIsUndefinedDownToTheResolution) {
  const FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{1.0 / x[0]}; });
  const Problem problem = problem_over(kernel, {{-1, 1}});
  Collector paving(problem);
  const Result result = solve(problem, exhaustive(0x1p-6), &paving);
  EXPECT_EQ(result.reason, Reason::kUndefined);
  EXPECT_EQ(paving.volumes.of(Claim::kUndecided).volume, Interval(0x1p-4));
  EXPECT_EQ(paving.volumes.of(Claim::kSingular).boxes, 0U);
}

TEST(Paving, CountsWhatAStopLeftOpen) {
  const FunctionKernel kernel = circle();
  const Problem problem = problem_over(kernel, kSquare);
  for (const std::uint64_t limit : {0U, 1U, 17U, 200U}) {
    Settings settings = exhaustive(0x1p-6);
    settings.max_boxes = limit;
    Collector paving(problem);
    static_cast<void>(solve(problem, settings, &paving));
    EXPECT_GT(paving.open, 0U);
    EXPECT_EQ(paving.volumes.unfinished().boxes, paving.open);
    EXPECT_EQ(sum_of_claims(paving.volumes), Interval(16.0)) << limit;
  }
}

TEST(Paving, EnclosesTheDeterminantOfEveryPiece) {
  const FunctionKernel kernel(1, 2, 2, [](const Values& x) {
    return Values{x[0] + 1.0, 1.0 - x[0], x[0], x[0] + 2.0};
  });
  const Problem problem = problem_over(kernel, {{0, 1}});
  Settings settings = exhaustive(0x1p-7);
  settings.split_certified = settings.enclose_determinants = true;
  Collector paving(problem);
  EXPECT_EQ(solve(problem, settings, &paving).verdict, Verdict::kNoSingularity);
  ASSERT_EQ(paving.leaves.size(), 128U);
  for (const Leaf& leaf : paving.leaves) {
    ASSERT_TRUE(leaf.determinant);
    for (const double x : {leaf.box[0].lo, mid(leaf.box[0]), leaf.box[0].hi})
      EXPECT_TRUE(contains(*leaf.determinant, 2 * x * x + 2 * x + 2)) << x;  // exact in doubles
    EXPECT_LT(leaf.determinant->hi - leaf.determinant->lo, 0.15);
  }
}

TEST(Paving, DividesTheDeterminantOfKAByThatOfK) {
  const FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{x[0] + 1.5}; });
  const Problem problem = problem_over(kernel, {{-1, 1}});
  Settings settings = exhaustive(1);
  settings.enclose_determinants = true;
  Collector paving(problem);
  static_cast<void>(solve(problem, settings, &paving));
  ASSERT_EQ(paving.leaves.size(), 1U);
  EXPECT_TRUE(certain_subset({0.5, 2.5}, *paving.leaves[0].determinant));
}

TEST(Paving, ClaimsNoSingularityWhereTheVarietyMayBeEmpty) {
  FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{x[0] * Interval(0.125)}; });
  // The constraint is positive everywhere, but intervals of this width do not show it.
  kernel.with_constraints(1,
                          [](const Values& x) { return Values{x[0] * x[0] - x[0] * x[0] + 0.1}; });
  for (const double alpha : {0.0, 1.0}) {
    const Problem problem = problem_over(kernel, {{-1, 1}}, Interval(alpha));
    Settings settings = exhaustive(0.5);
    Collector paving(problem);
    EXPECT_NE(solve(problem, settings, &paving).verdict, Verdict::kSingularity);
    EXPECT_EQ(paving.volumes.of(Claim::kSingular).boxes, 0U);
    EXPECT_GT(paving.volumes.of(Claim::kUndecided).boxes, 0U);
  }
}

TEST(Paving, GivesTheDeterminantOfTheScaledMatrixUnderAThreshold) {
  FunctionKernel kernel(1, 1, 1, [](const Values&) { return Values{Interval(3.0)}; });
  kernel.with_row_scale([](const Values&) { return Values{Interval(0.5)}; });
  for (const double alpha : {0.0, 1.0}) {
    const Problem problem = problem_over(kernel, {{0, 1}}, Interval(alpha));
    Settings settings = exhaustive(0.5);
    settings.enclose_determinants = true;
    Collector paving(problem);
    static_cast<void>(solve(problem, settings, &paving));
    EXPECT_TRUE(contains(*paving.leaves.at(0).determinant, alpha > 0 ? 1.5 : 3.0));
    EXPECT_LT(paving.leaves[0].determinant->hi, alpha > 0 ? 1.6 : 3.1);
  }
}

TEST(Volumes, EncloseTheTrueRangeFromBothSides) {
  const FunctionKernel kernel(3, 1, 1, [](const Values&) { return Values{Interval(1.0)}; });
  Problem problem = problem_over(kernel, {{0, 2}, {0, 3}, {5, 5}});
  problem.inner[0] = Interval(0.25, 1.5);
  const Volumes volumes(problem);
  EXPECT_EQ(volumes.axes(), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(volumes.total(), Interval(3.75, 6.0));
}

TEST(Volumes, HaveFractionsBetweenZeroAndOne) {
  const FunctionKernel kernel(1, 1, 1, [](const Values&) { return Values{Interval(1.0)}; });
  const Problem problem = problem_over(kernel, {{0, 0.3}});
  Volumes volumes(problem);
  volumes.add(Claim::kFree, std::vector<Interval>{{0, 0.3}});
  EXPECT_TRUE(contains(volumes.fraction(volumes.of(Claim::kFree)), 1.0));
  EXPECT_EQ(volumes.fraction(volumes.of(Claim::kFree)).hi, 1.0);
  EXPECT_EQ(volumes.fraction(volumes.of(Claim::kSingular)), Interval(0.0));
}

}  // namespace
}  // namespace regulus::detail
