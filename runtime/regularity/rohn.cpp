// SPDX-License-Identifier: Apache-2.0
// A vertex determinant is Laplace's sum over sets of columns of a minor of the upper rows times one
// of the lower three. For fixed v a row has two forms, uᵢ = ±1, so there are only a few minors for
// all choices of u; see minors_lanes.hpp.
//
// Error: each of the n! products is rounded at most h(h+1)/2 times in the minor of the h upper
// rows, b(b+1)/2 times in that of the b lower ones, and C(n, h) times in the product and the sum of
// both. That and the permanent, bounded once for magnitudes max(|lo|, |hi|), hold for all vertices.
#include "runtime/regularity/rohn.hpp"

#include <algorithm>

#include "runtime/regularity/backend.hpp"
#include "runtime/regularity/minors_error.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kMaxEntries = kMaxRohn * kMaxRohn;
constexpr std::size_t kLowerRows = 3;

std::size_t triangle(std::size_t k) noexcept { return k * (k + 1) / 2; }

std::size_t binomial(std::size_t n, std::size_t k) noexcept {
  std::size_t result = 1;
  for (std::size_t i = 1; i <= k; ++i) result = result * (n - k + i) / i;
  return result;
}

std::size_t roundings(std::size_t n) noexcept {
  const std::size_t lower = std::min(n, kLowerRows);
  return triangle(lower) + triangle(n - lower) + binomial(n, lower);
}

LaneNumbers errors_ru(ConstIntervalMatrix matrix) noexcept {
  const std::size_t n = matrix.rows();
  alignas(64) double numbers[kMaxEntries * kLanes];
  const PointMatrix magnitude(numbers, n, n);
  LaneNumbers permanent, error;
  for (std::size_t e = 0; e < n * n; ++e)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      magnitude.at(e, lane) = magnitude_of(matrix.lower(e, lane), matrix.upper(e, lane));
  regularity_backend().permanent(magnitude, raise_factor(n), permanent);
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    error[lane] = minors_error_ru(magnitude, lane, permanent[lane], roundings(n));
  return error;
}

bool certain_rohn(ConstIntervalMatrix matrix, std::size_t lane, double error) noexcept {
  BoundsOfOneLane bounds;
  bounds.n = matrix.rows();
  for (std::size_t e = 0; e < matrix.size(); ++e) {
    bounds.lo[e] = matrix.lower(e, lane);
    bounds.hi[e] = matrix.upper(e, lane);
  }
  return regularity_backend().vertices_share_sign(bounds, error);
}

}  // namespace

LaneMask certain_rohn(ConstIntervalMatrix matrix, LaneMask lanes) noexcept {
  LaneMask certain = 0;
  if (matrix.rows() > kMaxRohn || lanes == 0) return certain;
  const LaneNumbers error = errors_ru(matrix);
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    if (has_lane(lanes, lane) && certain_rohn(matrix, lane, error[lane])) certain |= 1U << lane;
  return certain;
}

}  // namespace regulus::detail
