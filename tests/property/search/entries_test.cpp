// SPDX-License-Identifier: GPL-3.0-or-later
// Compares enclosures of the entries that a method uses with exact values at points of the box.
#include <gtest/gtest.h>

#include "runtime/evaluation/batch.hpp"
#include "tests/support/function_kernel.hpp"
#include "tests/support/random_matrix.hpp"

namespace regulus::detail {
namespace {

using test::Exact;
using test::Random;
using test::RandomMatrix;
using test::Values;
using Side = ProductForm::Side;

constexpr Method kMethods[] = {Method::kReg, Method::kKj, Method::kJk, Method::kKjNumeric,
                               Method::kJkNumeric};

std::vector<Exact> exact_product(const std::vector<Exact>& A, const double* K, std::size_t lane,
                                 std::size_t n, Side side) {
  if (side == Side::kNone) return A;
  std::vector<Exact> product(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t p = 0; p < n; ++p) {
        const std::size_t of_K = side == Side::kLeft ? i * n + p : p * n + j;
        const std::size_t of_A = side == Side::kLeft ? p * n + j : i * n + p;
        product[i * n + j] = product[i * n + j] + Exact(K[point_at(of_K, lane)]) * A[of_A];
      }
  return product;
}

struct Widths {
  double natural = 0;
  double sharpened = 0;
};

/// Checks both enclosures of every entry of eight random boxes, at random points.
void check(Random& random, const RandomMatrix& kernel, Method method, Widths& widths) {
  const std::size_t n = kernel.get()->columns, variables = kernel.get()->variables;
  const Problem problem = test::problem_over(kernel, Values(variables, Interval(-1, 1)));
  const ProductForm form = form_of(method);
  Settings settings;
  settings.method = method;
  const RowStructure none;
  Batch natural(problem, settings, none);
  settings.entries = Entries::kDerivatives;
  Batch sharpened(problem, settings, none);
  Values boxes[kLanes];
  for (Batch* batch : {&natural, &sharpened}) batch->clear();
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    for (std::size_t k = 0; k < variables; ++k) {
      const double lo = test::uniform(random, -1, 1);
      boxes[lane].emplace_back(lo, random.one_in(5) ? lo : test::uniform(random, lo, 1));
    }
    for (Batch* batch : {&natural, &sharpened}) batch->load(lane, boxes[lane]);
  }
  for (Batch* batch : {&natural, &sharpened}) batch->seal(kLanes);
  LaneMask lanes = kAllLanes;
  const ConstIntervalMatrix wide = natural.product(form, lanes);
  const ConstIntervalMatrix narrow = sharpened.product(form, lanes);
  for_each_lane(lanes, [&](std::size_t lane) {
    for (std::size_t e = 0; e < n * n; ++e) {
      const Interval outer(wide.lower(e, lane), wide.upper(e, lane));
      const Interval inner(narrow.lower(e, lane), narrow.upper(e, lane));
      ASSERT_TRUE(certain_subset(inner, outer));
      widths.natural += outer.hi - outer.lo;
      widths.sharpened += inner.hi - inner.lo;
    }
    for (int sample = 0; sample < 12; ++sample) {
      std::vector<Exact> x;
      for (const Interval& range : boxes[lane])
        x.emplace_back(test::member(random, range.lo, range.hi));
      const std::vector<Exact> values =
          exact_product(kernel.entries(x), sharpened.preconditioner().data(), lane, n, form.side);
      for (std::size_t e = 0; e < n * n; ++e)
        ASSERT_TRUE(test::holds({narrow.lower(e, lane), narrow.upper(e, lane)}, values[e]))
            << name(method) << " entry " << e;
    }
  });
}

TEST(Entries, SharpenedByDerivativesEncloseEveryValueAndNothingMoreThanBefore) {
  Random random(201);
  for (const Method method : kMethods) {
    Widths widths;
    for (int round = 0; round < 60; ++round) {
      const unsigned n = 1 + static_cast<unsigned>(random.below(4));
      RandomMatrix kernel(random, 1 + static_cast<unsigned>(random.below(4)), n, n, 4.0);
      kernel.use_derivatives();
      if (random.one_in(3)) kernel.functions().left_product = nullptr;
      if (random.one_in(3)) kernel.functions().right_product = nullptr;
      check(random, kernel, method, widths);
    }
    EXPECT_LT(widths.sharpened, 0.95 * widths.natural) << name(method);
  }
}

/// §II-A: x² − 2x over [3, 5]; in this form its natural enclosure is not tight.
TEST(Entries, OfAMonotoneParabolaAreExact) {
  test::FunctionKernel kernel(
      1, 1, 1, [](const Values& x) -> Values { return {x[0] * x[0] - Interval(2.0) * x[0]}; });
  kernel.with_derivatives(
      [](const Values& x) -> Values { return {Interval(2.0) * x[0] - Interval(2.0)}; });
  const Problem problem = test::problem_over(kernel, {{3, 5}});
  Settings settings;
  settings.method = Method::kReg;
  for (const auto& [entries, expected] : {std::pair{Entries::kNatural, Interval(-1, 19)},
                                          std::pair{Entries::kDerivatives, Interval(3, 15)}}) {
    settings.entries = entries;
    Batch batch(problem, settings, {});
    batch.clear();
    batch.load(0, problem.outer);
    batch.seal(1);
    LaneMask lanes = 1U;
    const ConstIntervalMatrix entry = batch.product({}, lanes);
    EXPECT_EQ(Interval(entry.lower(0, 0), entry.upper(0, 0)), expected);
  }
}

TEST(Entries, KeepTheirNaturalEnclosureWhereADerivativeIsUndefined) {
  test::FunctionKernel kernel(1, 1, 1, [](const Values& x) -> Values { return {x[0]}; });
  kernel.with_derivatives([](const Values&) -> Values { return {kEntire}; });
  const Problem problem = test::problem_over(kernel, {{3, 5}});
  Settings settings;
  settings.method = Method::kReg;
  settings.entries = Entries::kDerivatives;
  EXPECT_EQ(solve(problem, settings).statistics.boxes, 1U);
  EXPECT_EQ(solve(problem, settings).verdict, Verdict::kNoSingularity);
}

}  // namespace
}  // namespace regulus::detail
