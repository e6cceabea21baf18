// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/regularity/midpoint_inverse.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <limits>
#include <vector>

#include "runtime/regularity/backend.hpp"
#include "tests/support/lane_arrays.hpp"

namespace regulus::detail {
namespace {

using test::Random;

LaneMask invert(const std::vector<double>& A, std::size_t m, std::size_t n, std::vector<double>& K,
                LaneNumbers& determinant) {
  return approx_inverse(ConstPointMatrix(A.data(), m, n), PointMatrix(K.data(), n, m), determinant);
}

/// Returns the largest |(KA − I)[i][j]| of a lane.
double residual(const std::vector<double>& K, const std::vector<double>& A, std::size_t m,
                std::size_t n, std::size_t lane) {
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      double sum = i == j ? -1.0 : 0.0;
      for (std::size_t p = 0; p < m; ++p)
        sum += K[point_at(i * m + p, lane)] * A[point_at(p * n + j, lane)];
      largest = std::max(largest, std::fabs(sum));
    }
  return largest;
}

TEST(MidpointInverse, InvertsRandomMatricesOfEveryOrder) {
  Random random(1);
  for (std::size_t n = 1; n <= kMaxColumns; ++n) {
    std::vector<double> A(n * n * kLanes), K(A.size());
    LaneNumbers det;
    for (double& x : A) x = test::uniform(random, -1, 1);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t l = 0; l < kLanes; ++l) A[point_at(i * n + i, l)] += 4.0;
    EXPECT_EQ(invert(A, n, n, K, det), 0U);
    for (std::size_t l = 0; l < kLanes; ++l) EXPECT_LT(residual(K, A, n, n, l), 1e-6) << n;
  }
}

TEST(MidpointInverse, ExchangesRowsLaneByLane) {
  // Lane 0 needs no exchange, lane 1 does; both have determinants of known sign.
  std::vector<double> A(4 * kLanes, 0.0), K(4 * kLanes);
  LaneNumbers det;
  for (std::size_t l = 0; l < kLanes; ++l) {
    const bool swapped = l % 2 == 1;
    A[point_at(swapped ? 1 : 0, l)] = 2.0;
    A[point_at(swapped ? 2 : 3, l)] = 3.0;
  }
  EXPECT_EQ(invert(A, 2, 2, K, det), 0U);
  for (std::size_t l = 0; l < kLanes; ++l) {
    EXPECT_EQ(det[l], l % 2 == 1 ? -6.0 : 6.0);
    EXPECT_LT(residual(K, A, 2, 2, l), 1e-7);
  }
}

TEST(MidpointInverse, FlagsExactlyTheSingularLanes) {
  std::vector<double> A(4 * kLanes), K(4 * kLanes);
  LaneNumbers det;
  for (std::size_t l = 0; l < kLanes; ++l) {
    A[point_at(0, l)] = 1.0;
    A[point_at(1, l)] = 2.0;
    A[point_at(2, l)] = 2.0;
    A[point_at(3, l)] = l == 3 ? 4.0 : 5.0;
  }
  EXPECT_EQ(invert(A, 2, 2, K, det), 1U << 3);
}

/// Returns true if the row consists of integers of at most 2^28 times a power of two.
bool is_on_grid(const std::vector<double>& row) {
  double greatest = 0;
  for (const double x : row) greatest = std::max(greatest, std::fabs(x));
  if (greatest == 0) return true;
  int exponent = 0;
  std::frexp(greatest, &exponent);  // greatest < 2^exponent
  for (int bits = 28; bits <= 29; ++bits) {
    const double step = std::ldexp(1.0, exponent - bits);
    if (std::all_of(row.begin(), row.end(), [step](double x) {
          return std::floor(x / step) * step == x && std::fabs(x / step) <= 0x1p28;
        }))
      return true;
  }
  return false;
}

TEST(MidpointInverse, PutsEachRowOnAGridInEveryRoundingMode) {
  Random random(4);
  const int saved = std::fegetround();
  for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
    for (int round = 0; round < 50; ++round) {
      const std::size_t m = round % 2 == 0 ? 6 : 8, n = 6;
      std::vector<double> A(m * n * kLanes), K(A.size());
      LaneNumbers det;
      for (std::size_t e = 0; e < m * n; ++e)
        for (std::size_t l = 0; l < kLanes; ++l)
          A[point_at(e, l)] =
              std::ldexp(test::uniform(random, -1, 1), static_cast<int>(e % n) * (round % 5));
      std::fesetround(mode);
      const LaneMask failed = invert(A, m, n, K, det);
      std::fesetround(saved);
      EXPECT_EQ(failed, 0U);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t l = 0; l < kLanes; ++l) {
          std::vector<double> row;
          for (std::size_t p = 0; p < m; ++p) row.push_back(K[point_at(i * m + p, l)]);
          EXPECT_TRUE(is_on_grid(row));
        }
    }
}

TEST(MidpointInverse, FlagsRowsThatAreTooSmallForAGrid) {
  std::vector<double> A(kLanes, 0x1p700), K(kLanes);
  LaneNumbers det;
  A[point_at(0, 2)] = 0x1p850;
  EXPECT_EQ(invert(A, 1, 1, K, det), 1U << 2);
}

TEST(MidpointInverse, InvertsTallMatricesFromTheLeftInMixedUnits) {
  Random random(2);
  const std::size_t m = 8, n = 6;
  std::vector<double> A(m * n * kLanes), K(A.size());
  LaneNumbers det;
  for (std::size_t e = 0; e < m * n; ++e)
    for (std::size_t l = 0; l < kLanes; ++l)
      A[point_at(e, l)] = test::uniform(random, -1, 1) * (e % n < 3 ? 1.0 : 1e7);
  EXPECT_EQ(invert(A, m, n, K, det), 0U);
  // With the units of the columns: (KA)[i][j] has unit j over unit i.
  for (std::size_t l = 0; l < kLanes; ++l) {
    std::vector<double> scaled_A = A, scaled_K = K;
    for (std::size_t p = 0; p < m; ++p)
      for (std::size_t j = 3; j < n; ++j) {
        scaled_A[point_at(p * n + j, l)] *= 1e-7;
        scaled_K[point_at(j * m + p, l)] *= 1e7;
      }
    EXPECT_LT(residual(scaled_K, scaled_A, m, n, l), 1e-6);
  }
}

/// Rows of the same matrices, with entries that are not finite, tiny, or 0.
TEST(MidpointInverse, InstructionSetsRoundAlike) {
  constexpr std::size_t n = 3;
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double rows[kLanes][n] = {{1, -0x1.23456789abcdfp-3, 3e-9},
                                      {0, -0.0, 0},
                                      {1, kNaN, 2},
                                      {kInfinity, 1, 1},
                                      {0x1p-801, 0x1p-900, 0},
                                      {-0x1.8p-800, 0x1p-820, 1e-300},
                                      {-1e300, 1e284, 7},
                                      {5e-324, 0, -1}};
  for (const Isa isa : kAllIsas) {
    if (!supported(isa)) continue;
    const RegularityBackend& backend = regularity_backend(isa);
    std::vector<double> rounded(n * kLanes), expected(n * kLanes);
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      for (std::size_t j = 0; j < n; ++j)
        rounded[point_at(j, lane)] = expected[point_at(j, lane)] = rows[lane][j];
    const PointMatrix row(rounded.data(), 1, n), same(expected.data(), 1, n);
    EXPECT_EQ(backend.within(row, 1e299), 0b10110111U) << static_cast<int>(isa);
    EXPECT_EQ(backend.round_rows_to_grid(row), 0b00011100U) << static_cast<int>(isa);
    EXPECT_EQ(regularity_backend(Isa::kPortable).round_rows_to_grid(same), 0b00011100U);
    for (const std::size_t lane : {0U, 1U, 5U, 6U, 7U})
      for (std::size_t j = 0; j < n; ++j)
        EXPECT_EQ(rounded[point_at(j, lane)], expected[point_at(j, lane)])
            << static_cast<int>(isa) << ' ' << lane;
    // 28 bits below the greatest entry.
    EXPECT_EQ(rounded[point_at(1, 0)], std::round(std::ldexp(rows[0][1], 27)) * 0x1p-27);
  }
}

}  // namespace
}  // namespace regulus::detail
