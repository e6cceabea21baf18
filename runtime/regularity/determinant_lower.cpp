// SPDX-License-Identifier: Apache-2.0
// Bounds det(I − P) from below. Elimination on a Z-matrix (off-diagonal entries ≤ 0) with positive
// pivots has terms of one sign only, so each step can be bounded: diagonal entries downward,
// magnitudes of the others upward. Each step replaces the Schur complement S by a Z-matrix S' ≤ S;
// if S' is a nonsingular M-matrix, so is S, and det S ≥ det S'.
#include <cstring>

#include "runtime/regularity/h_matrix.hpp"

namespace regulus::detail {
namespace {

constexpr double kOneTerm = raise_factor(1);
constexpr double kTwoTerms = raise_factor(2);

/// A bound below the exact value of one operation whose floating-point value is x, if the result is
/// positive: 4 units of 2^-52 for three roundings, 2^-1000 for underflow of the product.
double one_operation_rd(double x) noexcept { return x * (1.0 - 0x1p-50) - 0x1p-1000; }

struct ComparisonMatrix {
  alignas(64) double a[kMaxOrder * kMaxOrder * kLanes];
  std::size_t n;

  double& at(std::size_t i, std::size_t j, std::size_t lane) noexcept {
    return a[point_at(i * n + j, lane)];
  }

  void eliminate(std::size_t k, std::size_t i) noexcept {
    double factor[kLanes];
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      factor[lane] = raise_ru(at(i, k, lane) / at(k, k, lane), kOneTerm);
    for (std::size_t j = k + 1; j < n; ++j)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const double change = factor[lane] * at(k, j, lane);
        double& target = at(i, j, lane);
        target = i == j ? one_operation_rd(target - raise_ru(change, kOneTerm))
                        : raise_ru(target + change, kTwoTerms);
      }
  }
};

}  // namespace

LaneNumbers determinant_rd(ConstPointMatrix P) noexcept {
  const std::size_t n = P.rows();
  LaneNumbers lower;
  ComparisonMatrix matrix;
  matrix.n = n;
  std::memcpy(matrix.a, P.data(), n * n * kLanes * sizeof(double));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      matrix.at(i, i, lane) = one_operation_rd(1.0 - matrix.at(i, i, lane));
  for (std::size_t lane = 0; lane < kLanes; ++lane) lower[lane] = 1.0;
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double pivot = matrix.at(k, k, lane);
      const double product = one_operation_rd(lower[lane] * pivot);
      // A pivot that is not positive ends the lane: 0 stays 0, since 0·pivot gives product < 0.
      lower[lane] = pivot > 0.0 && product > 0.0 ? product : 0.0;
    }
    for (std::size_t i = k + 1; i < n; ++i) matrix.eliminate(k, i);
  }
  return lower;
}

}  // namespace regulus::detail
