// SPDX-License-Identifier: GPL-3.0-or-later
// A solver that is used again tells its observer the same as a new one, to the last bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

#include "tests/support/exact.hpp"
#include "tests/support/gough_kernel.hpp"
#include "tests/support/search_events.hpp"
#include "tests/support/unit_searches.hpp"

namespace regulus::detail {
namespace {

using test::FunctionKernel;
using test::problem_over;
using test::SearchEvents;
using test::UnitCase;
using test::Values;

const Interval kThird = Interval(1.0) / 3.0;

/// Problems that differ in everything that a solver keeps, and in how their searches end.
std::vector<UnitCase> cases() {
  std::vector<UnitCase> all = test::unit_cases();
  const std::size_t in_units = all.size();
  for (std::size_t i = 0; i < in_units; ++i) {
    UnitCase plain = all[i];
    plain.settings.boxes_before_units = ~std::uint64_t{0};
    all.push_back(plain);
  }
  const auto root = std::make_shared<FunctionKernel>(
      1, 1, 1, [](const Values& x) { return Values{sqrt(x[0]) + 1.0}; });
  const auto crossing =
      std::make_shared<FunctionKernel>(1, 1, 1, [](const Values& x) { return Values{x[0]}; });
  all.push_back({"defined", root, {{0.0, 1.0}}, {}, Verdict::kNoSingularity});
  all.push_back({"undefined", root, {{-0.25, 1.0}}, {}, Verdict::kPossibleProblem});
  all.push_back({"opposite signs", crossing, {{-1.0, 3.0}}, {}, Verdict::kSingularity});
  all.push_back({"zero at a point", crossing, {{-1.0, 1.0}}, {}, Verdict::kSingularity});
  return all;
}

std::string events_of(Solver& solver, const UnitCase& c, double alpha = 0.0) {
  SearchEvents events;
  static_cast<void>(solver.solve(problem_over(*c.kernel, c.ranges, alpha), c.settings, &events));
  return events.text;
}

TEST(KeptSolver, RepeatsASearchToTheBit) {
  for (const UnitCase& c : cases()) {
    Solver solver;
    const std::string first = events_of(solver, c);
    EXPECT_NE(first.find(name(c.verdict)), std::string::npos) << c.name;
    for (int again = 0; again < 3; ++again) EXPECT_EQ(events_of(solver, c), first) << c.name;
  }
}

TEST(KeptSolver, ForgetsTheProblemsBefore) {
  const std::vector<UnitCase> all = cases();
  Solver kept;
  for (std::size_t step = 1; step < all.size(); ++step)
    for (std::size_t i = 0; i < all.size(); ++i) {
      const UnitCase& c = all[i * step % all.size()];
      Solver fresh;
      EXPECT_EQ(events_of(kept, c), events_of(fresh, c)) << c.name;
    }
}

TEST(KeptSolver, TakesNewRangesAndThresholds) {
  UnitCase c = cases().back();
  Solver kept;
  for (const double end : {0.5, 2.0, 0.5, -0.5})
    for (const double alpha : {0.0, 0.75, 3.0}) {
      c.ranges = {{-1.0, end}};
      Solver fresh;
      EXPECT_EQ(events_of(kept, c, alpha), events_of(fresh, c, alpha)) << end << ' ' << alpha;
    }
}

/// Ranges that move, shrink to points, grow and come back, of kernels with constraints and uncertain
/// quantities too.
TEST(KeptSolver, FollowsRangesThatMove) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(-0.25, 1.25);
  for (const UnitCase& nominal : cases()) {
    Solver kept;
    for (int step = 0; step < 8; ++step) {
      UnitCase c = nominal;
      for (Interval& range : c.ranges) {
        const double width = range.hi - range.lo, a = range.lo + part(random) * width,
                     b = step % 4 == 3 ? a : range.lo + part(random) * width;
        if (step % 4 != 0) range = {std::min(a, b), std::max(a, b)};
      }
      c.settings.max_boxes = std::min<std::uint64_t>(c.settings.max_boxes, 500);
      for (const double alpha : {0.0, 0.25}) {
        Solver fresh;
        EXPECT_EQ(events_of(kept, c, alpha), events_of(fresh, c, alpha)) << c.name << ' ' << step;
      }
    }
  }
}

/// A function without zeros whose enclosures need many boxes, and the number of its evaluations.
struct CountedKernel {
  std::size_t evaluations = 0;
  FunctionKernel kernel{2, 1, 1, [this](const Values& x) {
                          ++evaluations;
                          return Values{x[0] * x[0] - x[0] * x[1] + x[1] * x[1] + 0.3};
                        }};
};

TEST(KeptSolver, DecidesOnlyTheLeavesOfASearchThatItKnows) {
  CountedKernel counted;
  Solver solver;
  const Problem problem = problem_over(counted.kernel, {{-1, 1}, {-1, 1.5}});
  const Result first = solver.solve(problem, {});
  const std::size_t at_first = std::exchange(counted.evaluations, 0);
  const Result second = solver.solve(problem, {});
  EXPECT_EQ(first.verdict, Verdict::kNoSingularity);
  EXPECT_EQ(second.statistics.boxes, first.statistics.boxes);
  EXPECT_GT(first.statistics.boxes, 16U);
  EXPECT_LT(3 * counted.evaluations, 2 * at_first);
}

TEST(KeptSolver, FindsTheSameOverAnotherRangeWithLittleMoreWork) {
  CountedKernel counted;
  Solver kept;
  static_cast<void>(kept.solve(problem_over(counted.kernel, {{-1, 1}, {-1, 1.5}}), {}));
  for (const double end : {1.25, 1.5, 4.0, -0.875}) {
    const Problem problem = problem_over(counted.kernel, {{-1, 1}, {-1, end}});
    SearchEvents with, without;
    Solver fresh;
    counted.evaluations = 0;
    static_cast<void>(fresh.solve(problem, {}, &without));
    const std::size_t of_fresh = std::exchange(counted.evaluations, 0);
    static_cast<void>(kept.solve(problem, {}, &with));
    EXPECT_EQ(with.text, without.text) << end;
    EXPECT_LE(counted.evaluations, of_fresh + of_fresh / 2) << end;
  }
}

TEST(KeptSolver, TakesNewBudgets) {
  UnitCase c = test::unit_cases().front();
  Solver kept;
  for (const std::uint64_t boxes : {400U, 7U, 0U, 100'000U, 7U}) {
    c.settings.max_boxes = boxes;
    Solver fresh;
    EXPECT_EQ(events_of(kept, c), events_of(fresh, c)) << boxes;
  }
}

TEST(KeptSolver, AsksTheOracleOfTheRun) {
  class Oracle final : public DeterminantOracle {
   public:
    std::optional<Interval> enclose(std::span<const Interval> point) noexcept override {
      return point[0] - kThird.lo;
    }
  };
  // This enclosure is too wide to have a sign: only the oracle knows it.
  const FunctionKernel kernel(
      1, 1, 1, [](const Values& x) { return Values{x[0] - kThird + Interval(-4, 4)}; });
  const Problem problem = problem_over(kernel, {{-1, 1}});
  Solver solver;
  Settings settings;
  for (int again = 0; again < 2; ++again) {
    settings.oracle = nullptr;
    EXPECT_EQ(solver.solve(problem, settings).verdict, Verdict::kPossibleProblem);
    const auto oracle = std::make_unique<Oracle>();
    settings.oracle = oracle.get();
    EXPECT_EQ(solver.solve(problem, settings).verdict, Verdict::kSingularity);
  }
}

TEST(KeptSolver, RefusesAFaultyProblemAndGoesOn) {
  const UnitCase c = cases().back();
  Solver solver;
  const std::string first = events_of(solver, c);
  EXPECT_EQ(solver.solve(Problem{problem_over(*c.kernel, {})}, {}).reason, Reason::kBadProblem);
  EXPECT_EQ(events_of(solver, c), first);
}

TEST(KeptSolver, MovesWithWhatItKeeps) {
  const UnitCase c = cases().back();
  Solver solver;
  const std::string first = events_of(solver, c);
  Solver moved = std::move(solver);
  EXPECT_EQ(events_of(moved, c), first);
}

TEST(KeptSolver, RepeatsASearchOfAPlatform) {
  const test::GoughKernel kernel(test::kRobot1);
  Problem problem;
  problem.kernel = kernel.get();
  for (const double degrees : {15.0, 40.0}) {
    const test::Angle angle = test::plus_minus_degrees(degrees);
    problem.outer = {{-15, 15}, {-15, 15}, {45, 50}, angle.outer, angle.outer, angle.outer};
    problem.inner = {{{-15, 15}}, {{-15, 15}}, {{45, 50}}, angle.inner, angle.inner, angle.inner};
    Solver solver;
    SearchEvents first, second;
    static_cast<void>(solver.solve(problem, {}, &first));
    static_cast<void>(solver.solve(problem, {}, &second));
    EXPECT_EQ(first.text, second.text) << degrees;
  }
}

}  // namespace
}  // namespace regulus::detail
