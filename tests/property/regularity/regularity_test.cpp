// SPDX-License-Identifier: GPL-3.0-or-later
// Checks every claim of a regularity test on members of the set, in exact arithmetic.
#include <gtest/gtest.h>

#include <vector>

#include "runtime/regularity/determinant.hpp"
#include "runtime/regularity/h_matrix.hpp"
#include "runtime/regularity/rohn.hpp"
#include "tests/support/lane_arrays.hpp"

namespace regulus::detail::regularity_test {
namespace {

using test::Exact;
using test::Random;

std::vector<double> random_intervals(Random& random, std::size_t entries, bool diagonal,
                                     std::size_t n, double spread) {
  std::vector<double> x(2 * entries * kLanes);
  for (std::size_t e = 0; e < entries; ++e)
    for (std::size_t l = 0; l < kLanes; ++l) {
      const double center =
          diagonal ? (e % (n + 1) == 0 ? 1.0 : 0.0) : test::uniform(random, -2, 2);
      const double a = center + test::uniform(random, -spread, spread);
      const double b = random.next() % 4 == 0 ? a : center + test::uniform(random, -spread, spread);
      x[lower_at(e, l)] = std::min(a, b);
      x[upper_at(e, l)] = std::max(a, b);
    }
  return x;
}

std::vector<Exact> random_member(Random& random, const std::vector<double>& x, std::size_t lane) {
  std::vector<Exact> member;
  for (const Interval& entry : test::interval_lane_of(x, lane))
    member.emplace_back(test::member(random, entry.lo, entry.hi));
  return member;
}

TEST(Regularity, HMatrixClaimsHoldForExactMembers) {
  Random random(11);
  std::size_t certified = 0, refused = 0;
  for (int round = 0; round < 400; ++round) {
    const std::size_t n = 1 + random.next() % 6;
    const double spread = test::uniform(random, 0.1, 2.5) / static_cast<double>(n);
    const std::vector<double> product = random_intervals(random, n * n, true, n, spread);
    std::vector<double> numbers(n * n * kLanes), v(n * kLanes);
    const PointMatrix P = test::points(numbers, n);
    distance_to_identity_ru(test::intervals(product, n), P);
    const LaneMask certain = certain_h_matrix(P, test::points(v));
    const LaneNumbers lower = determinant_rd(P);
    const LaneNumbers upper = determinant_ru(P, test::points(v));
    for (std::size_t l = 0; l < kLanes; ++l) {
      const bool regular = (certain >> l & 1U) != 0;
      ++(regular ? certified : refused);
      for (int sample = 0; sample < 12; ++sample) {
        const Exact det = determinant(random_member(random, product, l), n);
        ASSERT_LE(Exact(lower[l]), det.abs());
        if (!regular) continue;
        ASSERT_EQ(det.sign(), 1);  // regular matrices join it to I
        ASSERT_LE(det.abs(), Exact(upper[l]));
        ASSERT_GT(lower[l], 0.0);
      }
    }
  }
  EXPECT_GT(certified, 400U);
  EXPECT_GT(refused, 400U);
}

TEST(Regularity, ContractionMeansExactlyPvBelowV) {
  Random random(12);
  std::size_t certified = 0, refused = 0;
  for (int round = 0; round < 20000; ++round) {
    const std::size_t n = 1 + random.next() % 6;
    std::vector<double> P(n * n * kLanes), v(n * kLanes);
    for (double& x : P) x = std::fabs(test::awkward(random)) * 0.5;
    for (double& x : v) x = test::uniform(random, 0.5, 2);
    // Rows at the limit: (Pv)ᵢ ≈ vᵢ up to a few ulps.
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t l = 0; l < kLanes; ++l) {
        double sum = 0;
        for (std::size_t j = 0; j < n; ++j) sum += P[point_at(i * n + j, l)] * v[point_at(j, l)];
        if (!(sum > 0) || random.next() % 4 == 0) continue;
        const double edge = 1.0 - std::ldexp(test::uniform(random, -1, 4), -46);
        for (std::size_t j = 0; j < n; ++j)
          P[point_at(i * n + j, l)] *= v[point_at(i, l)] / sum * edge;
      }
    const LaneMask certain = certain_contraction(test::points(P, n), test::points(v));
    for (std::size_t l = 0; l < kLanes; l += 3) {
      ++((certain >> l & 1U) != 0 ? certified : refused);
      if ((certain >> l & 1U) == 0) continue;
      for (std::size_t i = 0; i < n; ++i) {
        Exact sum;
        for (std::size_t j = 0; j < n; ++j)
          sum = sum + Exact(P[point_at(i * n + j, l)]) * Exact(v[point_at(j, l)]);
        ASSERT_LT(sum, Exact(v[point_at(i, l)]));
      }
    }
  }
  EXPECT_GT(certified, 1000U);
  EXPECT_GT(refused, 1000U);
}

TEST(Regularity, RaisedSumsAreUpperBounds) {
  Random random(13);
  for (int round = 0; round < 100000; ++round) {
    const std::size_t terms = 1 + random.next() % 12;
    double sum = 0;
    Exact exact;
    for (std::size_t k = 0; k < terms; ++k) {
      const double a = std::fabs(test::awkward(random));
      const double b = std::fabs(test::awkward(random));
      sum += a * b;
      exact = exact + Exact(a) * Exact(b);
    }
    ASSERT_LE(exact, Exact(raise_ru(sum, raise_factor(terms))));
  }
}

TEST(Regularity, MeanValueBoundsHoldAlongTheBox) {
  // B(t) = B₀ + Σ tₖ Dₖ with thin Dₖ: the bound must hold at every t, and the ends reach it.
  Random random(14);
  for (int round = 0; round < 500; ++round) {
    const std::size_t n = 1 + random.next() % 4, variables = 1 + random.next() % 5;
    std::vector<double> center(n * n * kLanes), D(2 * variables * n * n * kLanes);
    std::vector<double> radius(variables * kLanes), P(n * n * kLanes, kInfinity);
    std::vector<double> B0(n * n * kLanes);
    for (double& x : B0) x = test::uniform(random, -1, 1);
    for (std::size_t e = 0; e < n * n * kLanes; ++e) center[e] = std::fabs(B0[e]);
    for (std::size_t d = 0; d < variables * n * n; ++d)
      for (std::size_t l = 0; l < kLanes; ++l)
        D[lower_at(d, l)] = D[upper_at(d, l)] = test::awkward(random);
    for (double& r : radius) r = std::fabs(test::awkward(random));
    lower_to_mean_value_ru(test::points(center, n), ConstIntervalMatrix(D.data(), variables, n * n),
                           test::points(radius), kAllLanes, test::points(P, n));
    const std::size_t l = random.next() % kLanes;
    for (std::size_t e = 0; e < n * n; ++e) {
      Exact value(B0[point_at(e, l)]);
      for (std::size_t k = 0; k < variables; ++k) {
        const double r = radius[point_at(k, l)];
        value = value + Exact(D[lower_at(k * n * n + e, l)]) * Exact(test::member(random, -r, r));
      }
      ASSERT_LE(value.abs(), Exact(P[point_at(e, l)]));
    }
  }
}

TEST(Regularity, DeterminantsEncloseExactMembers) {
  Random random(15);
  for (int round = 0; round < 3000; ++round) {
    const std::size_t n = 1 + random.next() % (round % 10 == 0 ? 7 : 5);
    const double spread = std::ldexp(1.0, -static_cast<int>(random.next() % 60));
    std::vector<double> x = random_intervals(random, n * n, false, n, spread);
    for (std::size_t e = 0; e < n * n; ++e)
      if (random.next() % 4 == 0) {
        const double a = test::awkward(random), b = test::awkward(random);
        x[lower_at(e, 0)] = std::min(a, b);
        x[upper_at(e, 0)] = std::max(a, b);
      }
    const LaneMatrix M = matrix_of_lane(test::intervals(x, n), 0);
    const Interval expanded = enclose_determinant(M);
    const Interval eliminated = enclose_determinant_by_elimination(M);
    for (int sample = 0; sample < 6; ++sample) {
      const Exact det = determinant(random_member(random, x, 0), n);
      ASSERT_TRUE(test::holds(expanded, det)) << n;
      ASSERT_TRUE(test::holds(eliminated, det)) << n;
    }
  }
}

TEST(Regularity, RohnClaimsHoldForExactMembers) {
  Random random(16);
  std::size_t certified = 0, refused = 0;
  for (int round = 0; round < 300; ++round) {
    const std::size_t n = 1 + random.next() % 5;
    const double spread = test::uniform(random, 0.05, 1.2);
    const std::vector<double> x =
        random_intervals(random, n * n, random.next() % 2 == 0, n, spread);
    const LaneMask certain = certain_rohn(test::intervals(x, n), kAllLanes);
    for (std::size_t l = 0; l < kLanes; ++l) {
      const bool regular = (certain >> l & 1U) != 0;
      ++(regular ? certified : refused);
      if (!regular) continue;
      const int sign = determinant(random_member(random, x, l), n).sign();
      for (int sample = 0; sample < 12; ++sample)
        ASSERT_EQ(determinant(random_member(random, x, l), n).sign(), sign);
      ASSERT_NE(sign, 0);
    }
  }
  EXPECT_GT(certified, 200U);
  EXPECT_GT(refused, 200U);
}

TEST(Regularity, RohnNeverCertifiesANearlySingularVertexFalsely) {
  // Thin matrices of rank n − 1 up to the last bit: no sign is given, or the right one.
  Random random(17);
  for (int round = 0; round < 4000; ++round) {
    const std::size_t n = 2 + random.next() % 3;
    std::vector<double> x(2 * n * n * kLanes);
    for (std::size_t l = 0; l < kLanes; ++l) {
      std::vector<double> a(n * n);
      for (double& entry : a) entry = test::uniform(random, -1, 1);
      for (std::size_t j = 0; j < n; ++j) a[(n - 1) * n + j] = 0.7 * a[j];
      for (std::size_t e = 0; e < n * n; ++e) x[lower_at(e, l)] = x[upper_at(e, l)] = a[e];
    }
    const LaneMask certain = certain_rohn(test::intervals(x, n), kAllLanes);
    for (std::size_t l = 0; l < kLanes; ++l)
      if ((certain >> l & 1U) != 0) {
        ASSERT_NE(determinant(random_member(random, x, l), n).sign(), 0);
      }
  }
}

}  // namespace
}  // namespace regulus::detail::regularity_test
