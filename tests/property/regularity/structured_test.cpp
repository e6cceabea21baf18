// SPDX-License-Identifier: GPL-3.0-or-later
// det K·A(t, u) in exact arithmetic against what T claims about it.
#include "regulus/regularity/structured.hpp"

#include <gtest/gtest.h>

#include "regulus/regularity/h_matrix.hpp"
#include "regulus/regularity/midpoint_inverse.hpp"
#include "support/lane_arrays.hpp"

namespace regulus {
namespace {

using test::Exact;
using test::Random;

/// A(t, u) = A₀ + t·A₁ + t²·A₂ + Σ_k u_k e_l(k) (w_k + t·w'_k)ᵀ; variable 0 is t, the others are u.
struct Family {
  std::size_t m, n, variables;
  std::vector<double> A0, A1, A2;          // m×n
  std::vector<std::size_t> row;            // of u_k
  std::vector<std::vector<double>> w, w1;  // n
  std::vector<double> radius;              // of t and each u; all midpoints 0

  Family(Random& random, std::size_t order, std::size_t extra_rows)
      : m(order + extra_rows), n(order) {
    const double size = std::ldexp(1.0, 2 - static_cast<int>(random.below(5)));
    for (std::size_t e = 0; e < m * n; ++e) {
      A0.push_back(test::uniform(random, -0.5, 0.5) + (e / n == e % n ? 2.0 : 0.0));
      A1.push_back(test::uniform(random, -1, 1));
      A2.push_back(test::uniform(random, -1, 1));
    }
    radius.push_back(size * test::uniform(random, 0, 0.5));
    for (std::size_t k = 0; k < 2 * m; ++k) {
      row.push_back(random.below(m));
      w.emplace_back();
      w1.emplace_back();
      for (std::size_t j = 0; j < n; ++j) {
        w.back().push_back(test::uniform(random, -1, 1));
        w1.back().push_back(random.one_in(2) ? 0.0 : test::uniform(random, -1, 1));
      }
      radius.push_back(size * test::uniform(random, 0, 0.3));
    }
    variables = radius.size();
  }

  [[nodiscard]] std::vector<Exact> at(const std::vector<Exact>& x) const {
    std::vector<Exact> A;
    for (std::size_t e = 0; e < m * n; ++e)
      A.push_back(Exact(A0[e]) + x[0] * (Exact(A1[e]) + x[0] * Exact(A2[e])));
    for (std::size_t k = 0; k < row.size(); ++k)
      for (std::size_t j = 0; j < n; ++j) {
        Exact& entry = A[row[k] * n + j];
        entry = entry + x[1 + k] * (Exact(w[k][j]) + x[0] * Exact(w1[k][j]));
      }
    return A;
  }

  [[nodiscard]] RowStructure structure() const {
    RowStructure result;
    result.slot.push_back(RowStructure::kWide);
    for (const std::size_t l : row) {
      const auto known = std::find(result.rows.begin(), result.rows.end(), l);
      result.slot.push_back(static_cast<int>(known - result.rows.begin()));
      if (known == result.rows.end()) result.rows.push_back(l);
    }
    return result;
  }

  [[nodiscard]] Interval range(std::size_t k) const { return {-radius[k], radius[k]}; }
};

/// Everything structured_bounds_ru wants, in lane 0 and copied to the others.
struct Inputs {
  std::vector<double> K, P, center, nominal, full, radius;

  static void put(std::vector<double>& x, std::size_t e, Interval value) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      x[lower_at(e, l)] = value.lo;
      x[upper_at(e, l)] = value.hi;
    }
  }

  Inputs(Random& random, const Family& f)
      : K(f.m * f.n * kLanes),
        P(f.n * f.n * kLanes),
        center(P.size()),
        nominal(2 * f.variables * f.n * f.n * kLanes),
        full(nominal.size()),
        radius(f.variables * kLanes) {
    std::vector<double> A(f.m * f.n * kLanes), det(kLanes);
    for (std::size_t e = 0; e < f.m * f.n; ++e)
      for (std::size_t l = 0; l < kLanes; ++l) A[point_at(e, l)] = f.A0[e];
    static_cast<void>(approx_inverse(A.data(), f.m, f.n, K.data(), det.data()));
    // A poor inverse is as legitimate as a good one, and leaves more to bound.
    for (std::size_t p = 0; p < f.m * f.n; ++p) {
      const double noise = 1.0 + test::uniform(random, -0.2, 0.2);
      for (std::size_t l = 0; l < kLanes; ++l) K[point_at(p, l)] *= noise;
    }
    for (std::size_t k = 0; k < f.variables; ++k)
      for (std::size_t l = 0; l < kLanes; ++l) radius[point_at(k, l)] = f.radius[k];
    std::vector<double> over_t(2 * f.n * f.n * kLanes), at_zero(over_t.size());
    for (std::size_t i = 0; i < f.n; ++i)
      for (std::size_t j = 0; j < f.n; ++j) fill(f, i, j, over_t, at_zero);
    distance_to_identity_ru(over_t.data(), f.n, P.data());
    distance_to_identity_ru(at_zero.data(), f.n, center.data());
  }

  void fill(const Family& f, std::size_t i, std::size_t j, std::vector<double>& over_t,
            std::vector<double>& at_zero) {
    const Interval t = f.range(0);
    Interval sum(0.0), sum0(0.0), slope(0.0), full_slope(0.0);
    for (std::size_t p = 0; p < f.m; ++p) {
      const Interval k(K[point_at(i * f.m + p, 0)]);
      const std::size_t e = p * f.n + j;
      sum += k * (Interval(f.A0[e]) + t * Interval(f.A1[e]) + sqr(t) * Interval(f.A2[e]));
      sum0 += k * Interval(f.A0[e]);
      slope += k * (Interval(f.A1[e]) + Interval(2.0) * t * Interval(f.A2[e]));
    }
    full_slope = slope;
    for (std::size_t u = 0; u < f.row.size(); ++u) {
      const Interval k(K[point_at(i * f.m + f.row[u], 0)]);
      full_slope += k * f.range(1 + u) * Interval(f.w1[u][j]);
      put(full, ((1 + u) * f.n + i) * f.n + j,
          k * (Interval(f.w[u][j]) + t * Interval(f.w1[u][j])));
    }
    put(over_t, i * f.n + j, sum);
    put(at_zero, i * f.n + j, sum0);
    put(nominal, i * f.n + j, slope);
    put(full, i * f.n + j, full_slope);
  }
};

TEST(Structured, ClaimsHoldForExactMembers) {
  Random random(21);
  int certified = 0, refused = 0;
  for (int round = 0; round < 600; ++round) {
    const Family f(random, 1 + random.below(4), random.below(2));
    const Inputs in(random, f);
    const RowStructure structure = f.structure();
    const std::size_t order = f.n + structure.rows.size();
    std::vector<double> T(order * order * kLanes), v(order * kLanes), lower(kLanes);
    std::vector<double> workspace(f.variables * f.n * f.n * kLanes);
    const LaneMask slopes = random.one_in(3) ? 0 : kEveryLane;
    structured_bounds_ru(
        structure,
        {f.m, f.n, f.variables, in.P.data(), in.center.data(), in.K.data(), in.nominal.data(),
         slopes, in.full.data(), in.radius.data(), workspace.data()},
        T.data());
    const bool regular = certain_h_matrix(T.data(), order, v.data()) == kEveryLane;
    determinant_rd(T.data(), order, lower.data());
    ++(regular ? certified : refused);
    for (int sample = 0; sample < 15; ++sample) {
      std::vector<Exact> x;
      for (const double r : f.radius) x.emplace_back(test::member(random, -r, r));
      const std::vector<Exact> A = f.at(x);
      std::vector<Exact> KA(f.n * f.n);
      for (std::size_t i = 0; i < f.n; ++i)
        for (std::size_t j = 0; j < f.n; ++j)
          for (std::size_t p = 0; p < f.m; ++p)
            KA[i * f.n + j] =
                KA[i * f.n + j] + Exact(in.K[point_at(i * f.m + p, 0)]) * A[p * f.n + j];
      const Exact det = determinant(KA, f.n);
      ASSERT_LE(Exact(lower[0]), det.abs());
      if (regular) {
        ASSERT_EQ(det.sign(), 1);
        ASSERT_GT(lower[0], 0.0);
      }
    }
  }
  EXPECT_GT(certified, 100);
  EXPECT_GT(refused, 100);
}

TEST(Structured, SeesMoreThanTheSumOfMagnitudes) {
  // Rows that vary along themselves only: |K∂_uA| alone would refuse far earlier.
  Random random(22);
  int structured_only = 0;
  for (int round = 0; round < 600; ++round) {
    const Family f(random, 4, 0);
    const Inputs in(random, f);
    const RowStructure structure = f.structure();
    const std::size_t order = f.n + structure.rows.size();
    std::vector<double> T(order * order * kLanes), v(order * kLanes);
    std::vector<double> workspace(f.variables * f.n * f.n * kLanes);
    structured_bounds_ru(
        structure,
        {f.m, f.n, f.variables, in.P.data(), in.center.data(), in.K.data(), in.nominal.data(),
         kEveryLane, in.full.data(), in.radius.data(), workspace.data()},
        T.data());
    std::vector<double> P(f.n * f.n * kLanes, kInfinity);
    lower_to_mean_value_ru(in.center.data(), in.full.data(), in.radius.data(), f.n, f.variables,
                           kEveryLane, P.data());
    const bool with = certain_h_matrix(T.data(), order, v.data()) != 0;
    const bool without = certain_h_matrix(P.data(), f.n, v.data()) != 0;
    if (with && !without) ++structured_only;
  }
  EXPECT_GT(structured_only, 10);
}

}  // namespace
}  // namespace regulus
