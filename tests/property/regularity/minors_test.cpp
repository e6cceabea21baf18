// SPDX-License-Identifier: GPL-3.0-or-later
// Compares determinants of eight matrices at once with exact arithmetic, on every instruction set.
#include "runtime/regularity/minors.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "runtime/regularity/backend.hpp"
#include "runtime/regularity/determinant.hpp"
#include "runtime/regularity/rohn.hpp"
#include "tests/support/lane_arrays.hpp"

namespace regulus::detail {
namespace {

using test::Exact;
using test::Random;

/// Returns matrices: some lanes are well scaled, some have zeros, subnormals and huge entries.
std::vector<double> random_matrices(Random& random, std::size_t n) {
  std::vector<double> x(2 * n * n * kLanes);
  for (std::size_t l = 0; l < kLanes; ++l) {
    const double spread = std::ldexp(1.0, -static_cast<int>(random.next() % 60));
    for (std::size_t e = 0; e < n * n; ++e) {
      const bool strange = l % 4 == 3 && random.next() % 3 == 0;
      const double center = test::uniform(random, -2, 2);
      const double a = strange ? test::awkward(random) : center;
      const double b = strange ? test::awkward(random) : center + spread;
      x[lower_at(e, l)] = std::min(a, b);
      x[upper_at(e, l)] = std::max(a, b);
    }
  }
  return x;
}

std::vector<Exact> random_member(Random& random, const std::vector<double>& x, std::size_t lane) {
  std::vector<Exact> member;
  for (const Interval& entry : test::interval_lane_of(x, lane))
    member.emplace_back(test::member(random, entry.lo, entry.hi));
  return member;
}

TEST(Minors, EnclosesTheDeterminantsOfExactMembers) {
  Random random(31);
  std::size_t bounded = 0;
  for (int round = 0; round < 600; ++round) {
    const std::size_t n = 1 + random.next() % (round % 20 == 0 ? 8 : 6);
    const std::vector<double> x = random_matrices(random, n);
    const LaneIntervals found = enclose_determinants(test::intervals(x, n));
    for (std::size_t l = 0; l < kLanes; ++l) {
      const Interval enclosure = found[l];
      bounded += is_bounded(enclosure);
      for (int sample = 0; sample < 4; ++sample)
        ASSERT_TRUE(test::holds(enclosure, determinant(random_member(random, x, l), n))) << n;
    }
  }
  EXPECT_GT(bounded, 3000U);
}

TEST(Minors, OfThinMatricesLosesLittleMoreThanTheRounding) {
  Random random(32);
  for (int round = 0; round < 100; ++round) {
    std::vector<double> x(2 * 36 * kLanes);
    for (std::size_t e = 0; e < 36; ++e)
      for (std::size_t l = 0; l < kLanes; ++l)
        x[lower_at(e, l)] = x[upper_at(e, l)] = test::uniform(random, -1, 1);
    const LaneIntervals found = enclose_determinants(test::intervals(x, 6));
    for (std::size_t l = 0; l < kLanes; ++l) EXPECT_LT(found[l].hi - found[l].lo, 1e-11);
  }
}

TEST(Minors, OfWideMatricesIsAboutAsTightAsTheRecursion) {
  Random random(33);
  double eight = 0, recursive = 0;
  for (int round = 0; round < 50; ++round) {
    std::vector<double> x(2 * 36 * kLanes);
    for (std::size_t e = 0; e < 36; ++e)
      for (std::size_t l = 0; l < kLanes; ++l) {
        const double center = e % 7 == 0 ? 1.0 : 0.0;
        x[lower_at(e, l)] = center - test::uniform(random, 0, 0.1);
        x[upper_at(e, l)] = center + test::uniform(random, 0, 0.1);
      }
    const LaneIntervals found = enclose_determinants(test::intervals(x, 6));
    for (std::size_t l = 0; l < kLanes; ++l) {
      const Interval one = enclose_determinant(matrix_of_lane(test::intervals(x, 6), l));
      eight += found[l].hi - found[l].lo;
      recursive += one.hi - one.lo;
    }
  }
  EXPECT_LT(eight, 1.02 * recursive);
}

TEST(Minors, BoundsNothingAfterAnOverflow) {
  std::vector<double> x(2 * 4 * kLanes, 1.0);
  x[lower_at(0, 2)] = x[upper_at(0, 2)] = 0x1p1000;
  x[lower_at(3, 2)] = x[upper_at(3, 2)] = 0x1p1000;
  const LaneIntervals found = enclose_determinants(test::intervals(x, 2));
  EXPECT_EQ(found[2], kEntire);
  EXPECT_TRUE(contains_zero(found[1]));
  EXPECT_LT(found[1].hi, 1e-14);
}

TEST(Minors, IsTheSameOnEveryInstructionSet) {
  Random random(34);
  for (int round = 0; round < 50; ++round) {
    const unsigned n = 1 + static_cast<unsigned>(random.next() % 7);
    const std::vector<double> drawn = random_matrices(random, n);
    alignas(64) double matrix[2 * 64 * kLanes], expected[2 * kLanes], found[2 * kLanes];
    std::copy(drawn.begin(), drawn.end(), matrix);
    const ConstIntervalMatrix M(matrix, n, n);
    BoundsOfOneLane bounds;
    bounds.n = n;
    for (std::size_t e = 0; e < M.size(); ++e)
      bounds.lo[e] = M.lower(e, 0), bounds.hi[e] = M.upper(e, 0);
    const RegularityBackend& reference = regularity_backend(Isa::kPortable);
    reference.expand(M, IntervalVector(expected, 1));
    const bool share = reference.vertices_share_sign(bounds, 1e-12);
    for (const Isa isa : kAllIsas) {
      if (!supported(isa)) continue;
      regularity_backend(isa).expand(M, IntervalVector(found, 1));
      for (std::size_t i = 0; i < 2 * kLanes; ++i)
        ASSERT_TRUE(found[i] == expected[i] || (std::isnan(found[i]) && std::isnan(expected[i])));
      EXPECT_EQ(regularity_backend(isa).vertices_share_sign(bounds, 1e-12), share);
    }
  }
}

/// Performs Rohn's test as it is published: every A^{uv}, in exact arithmetic.
bool exact_vertices_share_sign(const std::vector<Interval>& matrix, std::size_t n) {
  int shared = 0;
  for (std::size_t u = 0; u < 1U << n; ++u)
    for (std::size_t v = 0; v < 1U << n; ++v) {
      std::vector<Exact> vertex;
      for (std::size_t e = 0; e < n * n; ++e) {
        const bool opposite = ((u >> (e / n) ^ v >> (e % n)) & 1U) != 0;
        vertex.emplace_back(opposite ? matrix[e].hi : matrix[e].lo);
      }
      const int sign = determinant(vertex, n).sign();
      if (sign == 0 || (shared != 0 && sign != shared)) return false;
      shared = sign;
    }
  return true;
}

/// Eliminates with rounding to nearest; the result is far from 0 for the matrices below.
double approx_determinant(std::vector<double> a, std::size_t n) {
  double product = 1;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::fabs(a[i * n + k]) > std::fabs(a[best * n + k])) best = i;
    if (best != k) {
      for (std::size_t j = 0; j < n; ++j) std::swap(a[best * n + j], a[k * n + j]);
      product = -product;
    }
    product *= a[k * n + k];
    for (std::size_t i = k + 1; i < n; ++i)
      for (std::size_t j = k + 1; j < n; ++j)
        a[i * n + j] -= a[i * n + k] / a[k * n + k] * a[k * n + j];
  }
  return product;
}

TEST(Rohn, LooksAtEveryVertexOfLargeMatrices) {
  // Matrices around the identity; their radii are below and above the limit of regularity.
  Random random(36);
  for (const std::size_t n : {5U, 6U, 7U, 8U})
    for (int round = 0; round < 12; ++round) {
      std::vector<double> x(2 * n * n * kLanes);
      for (std::size_t e = 0; e < n * n; ++e) {
        const double center = e % (n + 1) == 0 ? 1.0 : 0.0;
        const double spread =
            test::uniform(random, 0.3, 1.0) * (round % 2 == 0 ? 0.5 : 1.5) / static_cast<double>(n);
        for (std::size_t l = 0; l < kLanes; ++l) {
          x[lower_at(e, l)] = center - spread;
          x[upper_at(e, l)] = center + spread;
        }
      }
      double least = kInfinity, most = -kInfinity;
      for (std::size_t u = 0; u < 1U << n; ++u)
        for (std::size_t v = 0; v < 1U << n; v += 2) {
          std::vector<double> vertex(n * n);
          for (std::size_t e = 0; e < n * n; ++e)
            vertex[e] =
                ((u >> (e / n) ^ v >> (e % n)) & 1U) != 0 ? x[upper_at(e, 0)] : x[lower_at(e, 0)];
          const double determinant = approx_determinant(vertex, n);
          least = std::min(least, determinant);
          most = std::max(most, determinant);
        }
      ASSERT_GT(std::fabs(least), 1e-9);
      EXPECT_EQ(certain_rohn(test::intervals(x, n), 1U), least > 0 || most < 0 ? 1U : 0U) << n;
    }
}

/// Returns the identity, except rows and columns i, k: [1, 2] on the diagonal, [0, widest] off it.
std::vector<double> one_block(std::size_t n, std::size_t i, std::size_t k, double widest) {
  std::vector<double> x(2 * n * n * kLanes);
  for (std::size_t e = 0; e < n * n; ++e) {
    const bool row = e / n == i || e / n == k, column = e % n == i || e % n == k;
    const bool diagonal = e % (n + 1) == 0;
    for (std::size_t l = 0; l < kLanes; ++l) {
      x[lower_at(e, l)] = diagonal ? 1.0 : 0.0;
      x[upper_at(e, l)] = row && column ? (diagonal ? 2.0 : widest) : (diagonal ? 1.0 : 0.0);
    }
  }
  return x;
}

TEST(Rohn, FindsTheOnlyBadVertexOfAnyTwoRows) {
  // det = ad − bc is least for low a, d and high b, c: one vertex up to the symmetry.
  for (std::size_t n = 2; n <= kMaxRohn; ++n)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = i + 1; k < n; ++k) {
        EXPECT_EQ(certain_rohn(test::intervals(one_block(n, i, k, 0.9), n), 1U), 1U) << n << i << k;
        EXPECT_EQ(certain_rohn(test::intervals(one_block(n, i, k, 1.1), n), 1U), 0U) << n << i << k;
      }
}

TEST(Rohn, AgreesWithTheVertexDeterminantsInExactArithmetic) {
  Random random(35);
  std::size_t certified = 0, refused = 0;
  for (int round = 0; round < 60; ++round) {
    const std::size_t n = 1 + random.next() % 4;
    std::vector<double> x(2 * n * n * kLanes);
    for (std::size_t e = 0; e < n * n; ++e)
      for (std::size_t l = 0; l < kLanes; ++l) {
        const double center = test::uniform(random, -2, 2), spread = test::uniform(random, 0, 0.4);
        x[lower_at(e, l)] = center - spread;
        x[upper_at(e, l)] = center + spread;
      }
    const LaneMask certain = certain_rohn(test::intervals(x, n), kAllLanes);
    for (std::size_t l = 0; l < kLanes; ++l) {
      const bool expected = exact_vertices_share_sign(test::interval_lane_of(x, l), n);
      EXPECT_EQ((certain >> l & 1U) != 0, expected) << n;
      ++(expected ? certified : refused);
    }
  }
  EXPECT_GT(certified, 50U);
  EXPECT_GT(refused, 50U);
}

}  // namespace
}  // namespace regulus::detail
