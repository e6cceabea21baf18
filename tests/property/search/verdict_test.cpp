// SPDX-License-Identifier: GPL-3.0-or-later
// Verdicts on random matrix functions against their exact determinants on a grid of points.
#include <gtest/gtest.h>

#include "support/function_kernel.hpp"
#include "support/lane_arrays.hpp"

namespace regulus {
namespace {

using test::Exact;
using test::Random;
using test::Values;

/// Entries c₀ + Σ cₖxₖ + Σ dₖxₖ² + e·x₀x₁ with coefficients of a few bits, so that exact arithmetic
/// on doubles is cheap.
class RandomMatrix : public test::FixtureKernel {
 public:
  RandomMatrix(Random& random, unsigned variables, unsigned rows, unsigned columns, double diagonal)
      : FixtureKernel(variables, variables, rows, columns) {
    for (unsigned i = 0; i < rows; ++i)
      for (unsigned j = 0; j < columns; ++j) {
        std::vector<double> c;
        for (unsigned k = 0; k < terms(); ++k) c.push_back(random.one_in(2) ? small(random) : 0.0);
        if (i == j) c[0] += diagonal;
        coefficients_.push_back(c);
      }
  }

  void use_derivatives() { enable_derivatives(); }
  /// The variable appears in one row only.
  void confine(unsigned variable, unsigned row) {
    const unsigned n = get()->variables;
    for (unsigned e = 0; e < coefficients_.size(); ++e) {
      if (e / get()->columns == row) continue;
      coefficients_[e][1 + variable] = coefficients_[e][1 + n + variable] = 0.0;
      if (variable < 2) coefficients_[e][1 + 2 * n] = 0.0;
    }
  }
  void constrain(std::vector<double> center, double radius, bool inside) {
    center_ = std::move(center);
    radius_ = radius;
    inside_ = inside;
    enable_constraints(1);
  }

  Values matrix(const Values& x) const override { return entries(x); }

  Values left_derivatives(const Values& x, std::span<const double> K) const override {
    const std::size_t m = get()->rows, n = get()->columns;
    Values out;
    for (std::size_t k = 0; k < get()->variables; ++k) {
      Values D;
      for (const auto& c : coefficients_) D.push_back(derivative(c, x, k));
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
          Interval sum(0.0);
          for (std::size_t p = 0; p < m; ++p) sum += Interval(K[i * m + p]) * D[p * n + j];
          out.push_back(sum);
        }
    }
    return out;
  }

  /// Inside, or outside, a ball.
  Values constraint(const Values& x) const override { return {constraint_at(x)}; }
  template <typename Number>
  [[nodiscard]] Number constraint_at(const std::vector<Number>& x) const {
    Number sum(0.0);
    for (std::size_t k = 0; k < x.size(); ++k) {
      const Number d = x[k] - Number(center_[k]);
      sum = sum + d * d;
    }
    const Number square(radius_ * radius_);
    return inside_ ? sum - square : square - sum;
  }
  [[nodiscard]] bool constrained() const { return !center_.empty(); }

  template <typename Number>
  [[nodiscard]] std::vector<Number> entries(const std::vector<Number>& x) const {
    std::vector<Number> A;
    for (const auto& c : coefficients_) {
      Number sum(c[0]);
      const std::size_t n = x.size();
      for (std::size_t k = 0; k < n; ++k)
        sum = sum + Number(c[1 + k]) * x[k] + Number(c[1 + n + k]) * x[k] * x[k];
      if (n > 1) sum = sum + Number(c[1 + 2 * n]) * x[0] * x[1];
      A.push_back(sum);
    }
    return A;
  }

 private:
  [[nodiscard]] unsigned terms() const { return 2 + 2 * get()->variables; }
  static double small(Random& random) {
    return std::ldexp(static_cast<double>(random.below(33)) - 16.0, -4);
  }
  static Interval derivative(const std::vector<double>& c, const Values& x, std::size_t k) {
    const std::size_t n = x.size();
    Interval sum = Interval(c[1 + k]) + Interval(2 * c[1 + n + k]) * x[k];
    if (n > 1 && k < 2) sum += Interval(c[1 + 2 * n]) * x[1 - k];
    return sum;
  }

  std::vector<std::vector<double>> coefficients_;
  std::vector<double> center_;
  double radius_ = 0.0;
  bool inside_ = true;
};

struct Grid {
  bool negative = false, zero = false, positive = false;
  bool any = false;
  Exact least;  // |det|
};

/// Exact determinants at the points of a grid that satisfy the constraint.
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
  settings.determinant = random.one_in(2) ? Determinant::kExpansion : Determinant::kElimination;
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
  // What a coarse grid sees, the search should nearly always find.
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
    // Outside a ball the variety may have several components, with a sign each.
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
  std::uint64_t structured = 0;
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
    structured += result.statistics.leaves[static_cast<std::size_t>(Rule::kStructured)];
    const Grid grid = look(kernel, ranges, 4);
    if (result.verdict == Verdict::kNoSingularity) {
      ASSERT_FALSE(grid.zero || (grid.negative && grid.positive)) << round;
    }
    if (result.verdict == Verdict::kSingularity) expect_true_witness(kernel, problem, result);
  }
  EXPECT_GT(tally.free, 50);
  EXPECT_GT(tally.singular, 50);
  EXPECT_GT(structured, 100U);
}

}  // namespace
}  // namespace regulus
