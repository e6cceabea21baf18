// SPDX-License-Identifier: GPL-3.0-or-later
// Compares det K·A(t, u) in exact arithmetic with the claims of the orthants about it.
#include "runtime/regularity/orthants.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/regularity/h_matrix.hpp"
#include "tests/property/regularity/second_order_cases.hpp"

namespace regulus::detail {
namespace {

using namespace test;  // the families, and exact arithmetic

/// Returns a member with uncertain quantities at the ends of their ranges and any t.
std::vector<Exact> extreme_member(const Family& f, Random& random) {
  std::vector<Exact> x = f.member(random);
  for (std::size_t k = kWide; k < f.variables && !f.in_balls; ++k)
    x[k] = Exact(random.one_in(2) ? f.radius[k] : -f.radius[k]);
  return x;
}

TEST(Orthants, ClaimsHoldForExactMembers) {
  Random random(31);
  int gained = 0, gained_by_products = 0, refused = 0;
  for (int round = 0; round < 4000; ++round) {
    Family f(random, 1 + random.below(4), random.below(2));
    // The tests differ most if the uncertainty dominates.
    const double pose = std::ldexp(1.0, -static_cast<int>(random.below(5)));
    const double curvature = std::ldexp(1.0, -static_cast<int>(random.below(6)));
    for (std::size_t p = 0; p < kWide; ++p) f.radius[p] *= pose;
    const double factor = std::exp2(test::uniform(random, 0, 5));
    for (std::size_t k = kWide; k < f.variables; ++k) f.radius[k] *= factor;
    for (auto& w : f.w)
      for (int part = 3; part < 5; ++part)
        for (double& x : w[static_cast<std::size_t>(part)]) x *= curvature;
    if (random.one_in(3)) f.put_in_balls();
    const Inputs in(random, f, 1e-3);
    const std::size_t moving = round % 4 == 0 ? random.below(kWide) : kWide;
    SecondOrderBounds bounds(in.lists, f.structure(), {.moving = moving});
    const std::size_t n = bounds.order();
    std::vector<double> numbers(n * n * kLanes), right(n * kLanes), left(n * kLanes);
    const PointMatrix T = test::points(numbers, n);
    const PointVector v = test::points(right), y = test::points(left);
    const SecondOrderInput input = in.input();
    bounds.bound_ru(input, T);
    if (certain_h_matrix(T, v) == kAllLanes) continue;
    static_cast<void>(approx_perron(T, {.right = v, .left = y}));
    OrthantCell hint{};
    if (bounds.certain_by_orthants(input, T, v, 1U, 0, hint) != 0) {
      ++gained;
    } else if (bounds.certain_by_orthants(input, T, v, 1U, 200, hint) != 0) {
      ++gained_by_products;
    } else {
      ++refused;
      continue;
    }
    for (int sample = 0; sample < 40; ++sample)
      ASSERT_EQ(determinant(product_with_K(f, in, f.at(extreme_member(f, random))), f.n).sign(), 1)
          << round;
  }
  EXPECT_GT(gained, 25);
  EXPECT_GT(gained_by_products, 25);
  EXPECT_GT(refused, 100);
}

/// Uses row l of A = I + diag(δ)·W. A is singular for some |δ_l| ≤ Δ if the vertex determinants
/// differ in sign, since the determinant is linear in each δ_l.
bool some_vertex_is_singular(const std::vector<double>& W, std::size_t n, double range) {
  for (unsigned signs = 0; signs < 1U << n; ++signs) {
    std::vector<Exact> A;
    for (std::size_t e = 0; e < n * n; ++e)
      A.push_back(Exact(e / n == e % n ? 1.0 : 0.0) +
                  Exact((signs >> (e / n) & 1U) != 0 ? -range : range) * Exact(W[e]));
    if (determinant(A, n).sign() <= 0) return true;
  }
  return false;
}

/// Makes a problem with one form for each row: c_l is row l of W.
OrthantProblem one_form_to_a_row(const std::vector<double>& W, unsigned n, double range) {
  OrthantProblem problem;
  problem.rows = problem.terms = n;
  for (unsigned l = 0; l <= n; ++l) problem.first_term[l] = l;
  for (unsigned l = 0; l < n; ++l) {
    problem.term[l] = {l, l + 1, range};
    problem.scale[l] = 1.0;
    for (unsigned j = 0; j < n; ++j) {
      const double c = W[l * n + j];
      problem.form[l * n + j] = c;
      problem.reach[l * n + j] = raise_ru(range * std::fabs(c), raise_factor(1));
      problem.slack[l * n + j] = 0x1p-40;
    }
  }
  return problem;
}

TEST(Orthants, ComeCloseToTheTruthAndNeverPassIt) {
  Random random(32);
  int close = 0, rounds = 0;
  for (; rounds < 60; ++rounds) {
    const unsigned n = 2 + static_cast<unsigned>(random.below(4));
    std::vector<double> W(n * n);
    for (double& w : W) w = test::uniform(random, -1, 1);
    double range = 0.05;
    OrthantCell hint{};
    while (range < 4.0 && certain_orthants_empty(one_form_to_a_row(W, n, range), hint)) {
      ASSERT_FALSE(some_vertex_is_singular(W, n, range)) << range;
      range *= 1.02;
    }
    close += some_vertex_is_singular(W, n, 1.1 * range);
  }
  EXPECT_GT(close, rounds / 2);
}

}  // namespace
}  // namespace regulus::detail
