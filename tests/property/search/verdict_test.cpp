// SPDX-License-Identifier: GPL-3.0-or-later
// Compares verdicts on random matrix functions with exact determinants on a grid of points.
#include <gtest/gtest.h>

#include "tests/support/function_kernel.hpp"
#include "tests/support/random_matrix.hpp"

namespace regulus::detail {
namespace {

using test::Exact;
using test::Random;
using test::RandomMatrix;

struct Grid {
  bool negative = false, zero = false, positive = false;
  bool any = false;
  Exact least;  // |det|
};

/// Computes exact determinants at the points of a grid that satisfy the constraint.
Grid look(const RandomMatrix& kernel, const std::vector<Interval>& ranges, int steps) {
  Grid grid;
  const std::size_t n = ranges.size();
  std::vector<int> index(n, 0);
  while (true) {
    std::vector<Exact> x;
    for (std::size_t k = 0; k < n; ++k) {
      const double width = ranges[k].hi - ranges[k].lo;
      x.emplace_back(ranges[k].lo + width * index[k] / steps);  // exact: few bits, steps = 2^s
    }
    if (!kernel.constrained() || kernel.constraint_at(x).sign() <= 0) {
      const Exact det = determinant(kernel.entries(x), kernel.get()->columns);
      (det.sign() < 0 ? grid.negative : det.sign() > 0 ? grid.positive : grid.zero) = true;
      if (!grid.any || det.abs() < grid.least) grid.least = det.abs();
      grid.any = true;
    }
    std::size_t k = 0;
    while (k < n && index[k] == steps) index[k++] = 0;
    if (k == n) return grid;
    ++index[k];
  }
}

Exact exact_determinant(const RandomMatrix& kernel, const WitnessPoint& point) {
  std::vector<Exact> x;
  for (const Interval& value : point.variables) x.emplace_back(value.lo);
  return determinant(kernel.entries(x), kernel.get()->columns);
}

void expect_true_witness(const RandomMatrix& kernel, const Problem& problem, const Result& result) {
  const Witness& witness = *result.witness;
  for (const WitnessPoint& point : witness.points) {
    std::vector<Exact> x;
    for (std::size_t k = 0; k < point.variables.size(); ++k) {
      ASSERT_TRUE(is_thin(point.variables[k]));
      ASSERT_TRUE(certain_subset(point.variables[k], *problem.inner[k]));
      x.emplace_back(point.variables[k].lo);
    }
    if (kernel.constrained()) {
      ASSERT_LE(kernel.constraint_at(x).sign(), 0);
    }
    ASSERT_TRUE(test::holds(point.determinant, exact_determinant(kernel, point)));
  }
  if (result.reason == Reason::kSmallDeterminant) {
    ASSERT_LE(exact_determinant(kernel, witness.points[0]).abs(), Exact(problem.alpha.lo));
  } else {
    ASSERT_EQ(exact_determinant(kernel, witness.points[0]).sign(), 1);
    ASSERT_EQ(exact_determinant(kernel, witness.points[1]).sign(), -1);
  }
}

struct Tally {
  int free = 0, singular = 0, open = 0;
  void count(Verdict verdict) {
    ++(verdict == Verdict::kNoSingularity ? free
       : verdict == Verdict::kSingularity ? singular
                                          : open);
  }
};

Method any_method(Random& random) { return static_cast<Method>(random.below(9)); }

Settings any_settings(Random& random) {
  Settings settings;
  settings.method = random.one_in(2) ? Method::kAuto : any_method(random);
  settings.determinant = static_cast<Determinant>(random.below(3));
  settings.entries = random.one_in(2) ? Entries::kNatural : Entries::kDerivatives;
  settings.bisection = static_cast<Bisection>(random.below(3));
  settings.batch = 1 + static_cast<unsigned>(random.below(8));
  settings.max_boxes = 1500;
  settings.boxes_after_problem = 50;
  return settings;
}

TEST(Verdict, NeverContradictsExactDeterminants) {
  Random random(101);
  Tally tally;
  int found = 0, missed = 0;
  for (int round = 0; round < 450; ++round) {
    const unsigned n = 2 + static_cast<unsigned>(random.below(5));
    const unsigned variables = 1 + static_cast<unsigned>(random.below(3));
    RandomMatrix kernel(random, variables, n, n, random.between(1, 8) > 4 ? 4.0 : 1.5);
    if (random.one_in(2)) kernel.use_derivatives();
    if (random.one_in(4)) kernel.functions().left_product = nullptr;
    if (random.one_in(4)) kernel.functions().right_product = nullptr;
    const std::vector<Interval> ranges(variables, Interval(-1, random.one_in(2) ? 1 : -0.5));
    const Problem problem = test::problem_over(kernel, ranges);
    const Result result = solve(problem, any_settings(random));
    tally.count(result.verdict);
    const Grid grid = look(kernel, ranges, variables == 3 ? 4 : 8);
    if (result.verdict == Verdict::kNoSingularity) {
      ASSERT_FALSE(grid.zero) << round;
      ASSERT_FALSE(grid.negative && grid.positive) << round;
    }
    if (result.verdict == Verdict::kSingularity) expect_true_witness(kernel, problem, result);
    if (grid.negative && grid.positive)
      ++(result.verdict == Verdict::kSingularity ? found : missed);
  }
  EXPECT_GT(tally.free, 60);
  EXPECT_GT(tally.singular, 60);
  // The search should nearly always find the singularities that a coarse grid shows.
  EXPECT_LT(20 * missed, found);
}

TEST(Verdict, ThresholdsNeverContradictExactDeterminants) {
  Random random(102);
  Tally tally;
  for (int round = 0; round < 400; ++round) {
    const unsigned n = 2 + static_cast<unsigned>(random.below(4));
    const unsigned variables = 1 + static_cast<unsigned>(random.below(2));
    RandomMatrix kernel(random, variables, n, n, 4.0);
    if (random.one_in(2)) kernel.use_derivatives();
    const std::vector<Interval> ranges(variables, Interval(-0.5, 0.5));
    const double alpha = std::pow(random.between(0.5, 4.5), n);
    const Problem problem = test::problem_over(kernel, ranges, Interval(alpha));
    const Result result = solve(problem, any_settings(random));
    tally.count(result.verdict);
    const Grid grid = look(kernel, ranges, 8);
    if (result.verdict == Verdict::kNoSingularity) {
      ASSERT_LT(Exact(alpha), grid.least) << round;
    }
    if (result.verdict == Verdict::kSingularity) expect_true_witness(kernel, problem, result);
  }
  EXPECT_GT(tally.free, 50);
  EXPECT_GT(tally.singular, 50);
}

TEST(Verdict, ConstraintsNeverContradictExactDeterminants) {
  Random random(103);
  Tally tally;
  for (int round = 0; round < 400; ++round) {
    const unsigned n = 2 + static_cast<unsigned>(random.below(3));
    RandomMatrix kernel(random, 2, n, n, random.one_in(2) ? 3.0 : 1.0);
    if (random.one_in(2)) kernel.use_derivatives();
    // Outside a ball the variety may have several components, each with its own sign.
    const bool inside = random.one_in(2);
    kernel.constrain({random.between(-0.5, 0.5), random.between(-0.5, 0.5)},
                     random.between(0.25, 1.25), inside);
    const std::vector<Interval> ranges(2, Interval(-1, 1));
    const Problem problem = test::problem_over(kernel, ranges);
    const Result result = solve(problem, any_settings(random));
    tally.count(result.verdict);
    const Grid grid = look(kernel, ranges, 16);
    if (result.verdict == Verdict::kNoSingularity) {
      ASSERT_FALSE(grid.zero) << round;
      // A disc cut by a square is connected.
      if (inside) {
        ASSERT_FALSE(grid.negative && grid.positive) << round;
      }
    }
    if (result.verdict == Verdict::kSingularity) expect_true_witness(kernel, problem, result);
  }
  EXPECT_GT(tally.free, 50);
  EXPECT_GT(tally.singular, 50);
}

TEST(Verdict, TallMatricesAreOfFullRankWhereCertified) {
  Random random(104);
  Tally tally;
  for (int round = 0; round < 200; ++round) {
    const unsigned n = 2 + static_cast<unsigned>(random.below(4));
    const unsigned m = n + 1 + static_cast<unsigned>(random.below(2));
    RandomMatrix kernel(random, 2, m, n, random.one_in(2) ? 3.0 : 1.0);
    if (random.one_in(2)) kernel.use_derivatives();
    const Problem problem = test::problem_over(kernel, {{-1, 1}, {-1, 1}});
    Settings settings;
    settings.max_boxes = 1000;
    const Result result = solve(problem, settings);
    tally.count(result.verdict);
    ASSERT_NE(result.verdict, Verdict::kSingularity);
    if (result.verdict != Verdict::kNoSingularity) continue;
    for (int sample = 0; sample < 30; ++sample) {
      const std::vector<Exact> A =
          kernel.entries<Exact>({test::member(random, -1, 1), test::member(random, -1, 1)});
      std::vector<Exact> gram(n * n);
      for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j)
          for (unsigned p = 0; p < m; ++p)
            gram[i * n + j] = gram[i * n + j] + A[p * n + i] * A[p * n + j];
      ASSERT_EQ(determinant(gram, n).sign(), 1) << round;
    }
  }
  EXPECT_GT(tally.free, 50);
}

TEST(Verdict, UncertainQuantitiesNeverContradictExactDeterminants) {
  Random random(105);
  Tally tally;
  for (int round = 0; round < 300; ++round) {
    const unsigned n = 2 + static_cast<unsigned>(random.below(3));
    RandomMatrix kernel(random, 3, n, n, random.one_in(2) ? 3.0 : 1.5);
    kernel.functions().motion_variables = 1;
    kernel.functions().pose_parameters = 1;
    if (random.one_in(2)) kernel.use_derivatives();
    if (random.one_in(2)) kernel.confine(1, static_cast<unsigned>(random.below(n)));
    if (random.one_in(2)) kernel.confine(2, static_cast<unsigned>(random.below(n)));
    const double e = std::ldexp(1.0, -static_cast<int>(random.below(5)));
    const std::vector<Interval> ranges{{-1, 1}, {-e, e}, {-e, e}};
    const Problem problem = test::problem_over(kernel, ranges);
    Settings settings = any_settings(random);
    settings.uncertainty = random.one_in(2) ? Uncertainty::kElements : Uncertainty::kVariables;
    const Result result = solve(problem, settings);
    tally.count(result.verdict);
    const Grid grid = look(kernel, ranges, 4);
    if (result.verdict == Verdict::kNoSingularity) {
      ASSERT_FALSE(grid.zero || (grid.negative && grid.positive)) << round;
    }
    if (result.verdict == Verdict::kSingularity) expect_true_witness(kernel, problem, result);
  }
  EXPECT_GT(tally.free, 50);
  EXPECT_GT(tally.singular, 50);
}

}  // namespace
}  // namespace regulus::detail
