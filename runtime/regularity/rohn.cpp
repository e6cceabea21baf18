// SPDX-License-Identifier: Apache-2.0
// A vertex determinant is Laplace's sum over sets of columns of a minor of the upper rows times one
// of the lower three. For fixed v a row has two forms, uᵢ = ±1, so that the minors of all choices
// of u are few; see minors_lanes.hpp.
//
// Error: each of the n! products is rounded at most h(h+1)/2 times in the minor of the h upper
// rows, b(b+1)/2 times in that of the b lower ones, and C(n, h) times in the product and the sum of
// both. That and the permanent, bounded once for magnitudes max(|lo|, |hi|), hold for all vertices.
#include "regulus/regularity/rohn.hpp"

#include <algorithm>

#include "regulus/regularity/backend.hpp"
#include "regulus/regularity/minors_error.hpp"

namespace regulus {
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

void errors_ru(const double* matrix, std::size_t n, double* error) noexcept {
  alignas(64) double magnitude[kMaxEntries * kLanes];
  alignas(64) double permanent[kLanes];
  for (std::size_t e = 0; e < n * n; ++e)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      magnitude[point_at(e, lane)] =
          magnitude_of(matrix[lower_at(e, lane)], matrix[upper_at(e, lane)]);
  regularity_backend().permanent(magnitude, static_cast<unsigned>(n), raise_factor(n), permanent);
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    error[lane] = minors_error_ru(magnitude, n, lane, permanent[lane], roundings(n));
}

bool certain_rohn(const double* matrix, std::size_t n, std::size_t lane, double error) noexcept {
  double lo[kMaxEntries], hi[kMaxEntries];
  for (std::size_t e = 0; e < n * n; ++e) {
    lo[e] = matrix[lower_at(e, lane)];
    hi[e] = matrix[upper_at(e, lane)];
  }
  return regularity_backend().vertices_share_sign(lo, hi, static_cast<unsigned>(n), error);
}

}  // namespace

LaneMask certain_rohn(const double* matrix, std::size_t n, LaneMask lanes) noexcept {
  LaneMask certain = 0;
  if (n > kMaxRohn || lanes == 0) return certain;
  double error[kLanes];
  errors_ru(matrix, n, error);
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    if ((lanes >> lane & 1U) != 0 && certain_rohn(matrix, n, lane, error[lane]))
      certain |= 1U << lane;
  return certain;
}

}  // namespace regulus
