// SPDX-License-Identifier: GPL-3.0-or-later
// Compares det K·A(t, u) in exact arithmetic with the claims of T about it.
#include "runtime/regularity/second_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/regularity/h_matrix.hpp"
#include "tests/property/regularity/second_order_cases.hpp"

namespace regulus::detail {
namespace {

using namespace test;  // the families, and exact arithmetic

TEST(SecondOrder, ClaimsHoldForExactMembers) {
  Random random(21);
  int certified = 0, refused = 0, moving = 0;
  for (int round = 0; round < 600; ++round) {
    Family f(random, 1 + random.below(4), random.below(2));
    if (random.one_in(2)) f.put_in_balls();
    const Inputs in(random, f);
    const Isa isa = kAllIsas[static_cast<std::size_t>(round) / 3 % kAllIsas.size()];
    if (!supported(isa)) continue;
    // K moves with t₀ and t₁, with t₀, or not at all.
    const SecondOrderOptions options{.moving = kWide - static_cast<std::size_t>(round) % 3,
                                     .keeps_shares = random.one_in(2)};
    const Bounds bounds(f, in, options, regularity_backend(isa));
    ++(bounds.regular ? certified : refused);
    for (int sample = 0; sample < 12; ++sample) {
      const Exact det = determinant(product_with_K(f, in, f.at(f.member(random))), f.n);
      if (bounds.regular) {
        ASSERT_EQ(det.sign(), 1) << round;
        ASSERT_GT(bounds.lower[0], 0.0) << round;
      }
      // |det K₀A| ≥ lower·|det K₀|/|det K(t)|.
      if (bounds.moving[0] < kInfinity) {
        ++moving;
        ASSERT_LE(Exact(bounds.lower[0]), det.abs() * Exact(bounds.moving[0])) << round;
      }
    }
  }
  EXPECT_GT(certified, 80);
  EXPECT_GT(refused, 80);
  EXPECT_GT(moving, 500);
}

/// The matrix is 1 plus one monomial of the family, which is `least` where it is least.
Family one_monomial(Random& random, std::size_t part, bool of_row, double least) {
  Family f(random, 1, 0);
  f.radius.assign(f.variables, 0.5);
  for (std::vector<double>& coefficient : f.A) coefficient[0] = 0.0;
  for (auto& w : f.w)
    for (std::vector<double>& coefficient : w) coefficient[0] = 0.0;
  f.A[0][0] = 1.0;
  const std::size_t degree = of_row ? (part == 0   ? 1
                                       : part == 2 ? 3
                                                   : 2)
                                    : (part < 3   ? 1
                                       : part < 5 ? 2
                                                  : 3);
  (of_row ? f.w[1][part] : f.A[part])[0] = std::ldexp(least, static_cast<int>(degree));
  return f;
}

/// Random members hardly ever need a term that is small beside the others.
TEST(SecondOrder, NoTermIsLeftOut) {
  Random random(26);
  for (const bool of_row : {false, true})
    for (std::size_t part = of_row ? 0 : 1; part < (of_row ? 5U : 6U); ++part)
      for (const std::size_t moving : {std::size_t{0}, std::size_t{1}, kWide})
        for (const bool keeps_shares : {false, true}) {
          const SecondOrderOptions options{.moving = moving, .keeps_shares = keeps_shares};
          const auto regular = [&](double least) {
            const Family f = one_monomial(random, part, of_row, least);
            return Bounds(f, Inputs(random, f, 0.0), options).regular;
          };
          EXPECT_FALSE(regular(-1.0)) << of_row << ' ' << part << ' ' << moving;
          EXPECT_TRUE(regular(-0.1)) << of_row << ' ' << part << ' ' << moving;
        }
}

TEST(SecondOrder, ABallIsBoundedBetterThanTheBoxAroundIt) {
  Random random(24);
  int better = 0;
  for (int round = 0; round < 100; ++round) {
    Family f(random, 4, 0);
    f.put_in_balls();
    Random same(round);
    const Inputs in(same, f);
    const Bounds ball(f, in);
    f.in_balls = false;
    const Bounds box(f, in);
    double most = 0;
    for (std::size_t e = 0; e < ball.T.size(); ++e) {
      ASSERT_LE(ball.T[e], box.T[e] * (1 + 1e-9));
      most = std::max(most, box.T[e] - ball.T[e]);
    }
    better += most > 1e-3;
  }
  EXPECT_GT(better, 90);
}

TEST(SecondOrder, WithoutMovingKeepsThePreconditionerWhereItIs) {
  Random random(25);
  for (int round = 0; round < 20; ++round) {
    Family f(random, 3, 0);
    const Inputs in(random, f);
    for (const double moving : Bounds(f, in, {.moving = 0}).moving.of)
      EXPECT_EQ(moving, std::nextafter(1.0, 2.0));
  }
}

TEST(SecondOrder, LosesNothingOfFirstOrderInThePose) {
  // The bound of E keeps only terms that are quadratic in the radius: for a tenth of the radius,
  // about a hundredth of P.
  Random random(22);
  for (int round = 0; round < 50; ++round) {
    Family f(random, 4, 0);
    f.row.clear();
    f.w.clear();
    f.radius.assign(kWide, 0.01);
    f.variables = kWide;
    const auto largest = [&](double radius) {
      f.radius.assign(kWide, radius);
      Random same(23);
      Inputs in(same, f);
      // K is the inverse itself, so that no other error is left.
      std::vector<double> A(16 * kLanes);
      LaneNumbers det;
      for (std::size_t e = 0; e < 16; ++e)
        for (std::size_t l = 0; l < kLanes; ++l) A[point_at(e, l)] = f.A[0][e];
      static_cast<void>(approx_inverse(test::points(A, 4), test::points(in.K, 4), det));
      Inputs exact = in;
      exact.product.clear();
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
          exact.product.insert(exact.product.end(), 2 * kLanes, i == j ? 1.0 : 0.0);
        }
      const Bounds bounds(f, exact);
      return *std::max_element(bounds.T.begin(), bounds.T.end());
    };
    EXPECT_LT(largest(0.001), 0.012 * largest(0.01)) << round;
  }
}

}  // namespace
}  // namespace regulus::detail
