// SPDX-License-Identifier: Apache-2.0
// Eight vertex matrices at a time. Their determinants come from minors over sets of columns: with
// D(S) the minor of the first |S| rows and the columns S, D(S) = Σ_{j∈S} ±A[|S|−1][j]·D(S∖{j}).
//
// Error: the determinant is a sum of n! products, each rounded at most once by a multiplication and
// k − 1 times by additions at every level k = 2…n, in all at most t = n(n+1)/2 − 1 times. With
// u = 2^-52 (any rounding mode) the error is below ((1+u)^t − 1)·perm|A| ≤ 2tu·perm|A|, apart from
// underflows: at each of the fewer than n·2^n products at most 2^-1074 is lost, and is multiplied
// on by a sub-permanent of the remaining rows. With M = max(1, largest |A[i][j]|) that is below
// n·2^n·2^-1074·n!·M^n ≤ 2^-1040·M^n for n ≤ 8. The permanent is bounded once, for magnitudes
// max(|lo|, |hi|), which hold for all vertices.
#include "regulus/regularity/rohn.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace regulus {
namespace {

constexpr std::size_t kMaxSets = std::size_t{1} << kMaxRohn;

struct Bounds {
  std::size_t n;
  double lo[kMaxRohn * kMaxRohn];
  double hi[kMaxRohn * kMaxRohn];
};

Bounds bounds_of_lane(const double* matrix, std::size_t n, std::size_t lane) noexcept {
  Bounds bounds{n, {}, {}};
  for (std::size_t e = 0; e < n * n; ++e) {
    bounds.lo[e] = matrix[lower_at(e, lane)];
    bounds.hi[e] = matrix[upper_at(e, lane)];
  }
  return bounds;
}

double magnitude(const Bounds& bounds, std::size_t e) noexcept {
  return std::max(std::fabs(bounds.lo[e]), std::fabs(bounds.hi[e]));
}

double permanent_ru(const Bounds& bounds) noexcept {
  const std::size_t n = bounds.n;
  const double factor = raise_factor(n);
  double permanent[kMaxSets] = {1.0};
  for (std::size_t set = 1; set < std::size_t{1} << n; ++set) {
    const std::size_t row = static_cast<std::size_t>(std::popcount(set)) - 1;
    double sum = 0.0;
    for (std::size_t j = 0; j < n; ++j)
      if ((set >> j & 1U) != 0)
        sum += magnitude(bounds, row * n + j) * permanent[set & ~(std::size_t{1} << j)];
    permanent[set] = raise_ru(sum, factor);
  }
  return permanent[(std::size_t{1} << n) - 1];
}

double error_bound_ru(const Bounds& bounds) noexcept {
  const std::size_t n = bounds.n;
  double largest = 1.0;
  for (std::size_t e = 0; e < n * n; ++e) largest = std::max(largest, magnitude(bounds, e));
  double power = 0x1p-1040;
  for (std::size_t k = 0; k < n; ++k) power = power * largest * (1.0 + 0x1p-50) + 0x1p-1074;
  const double roundings = static_cast<double>(n * (n + 1) / 2);
  return raise_ru(permanent_ru(bounds) * (roundings * 0x1p-51) + power, raise_factor(3));
}

/// Vertex number c: bits 0…n−1 are v, bits n…2n−2 are u₁…, and u₀ = 1 as A^{uv} = A^{−u,−v}.
void fill_vertices(const Bounds& bounds, std::size_t first, double* vertex) noexcept {
  const std::size_t n = bounds.n;
  const std::size_t count = std::size_t{1} << (2 * n - 1);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::size_t c = (first + lane) % count;
    const std::size_t u = c >> n << 1;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const bool opposite = ((u >> i ^ c >> j) & 1U) != 0;
        vertex[point_at(i * n + j, lane)] = opposite ? bounds.hi[i * n + j] : bounds.lo[i * n + j];
      }
  }
}

void determinants(const double* vertex, std::size_t n, double* minors) noexcept {
  for (std::size_t lane = 0; lane < kLanes; ++lane) minors[lane] = 1.0;
  for (std::size_t set = 1; set < std::size_t{1} << n; ++set) {
    double sum[kLanes] = {};
    const std::size_t row = static_cast<std::size_t>(std::popcount(set)) - 1;
    std::size_t after = row;  // columns of the set to the right of j; even: sign +
    for (std::size_t j = 0; j < n; ++j) {
      if ((set >> j & 1U) == 0) continue;
      const double sign = after-- % 2 == 0 ? 1.0 : -1.0;
      const double* entry = vertex + (row * n + j) * kLanes;
      const double* minor = minors + (set & ~(std::size_t{1} << j)) * kLanes;
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        sum[lane] += sign * entry[lane] * minor[lane];
    }
    std::copy(sum, sum + kLanes, minors + set * kLanes);
  }
}

/// The sign that all eight determinants share beyond the error, or 0.
int common_sign(const double* determinant, double error) noexcept {
  bool positive = true;
  bool negative = true;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    positive = positive && determinant[lane] > error;
    negative = negative && -determinant[lane] > error;
  }
  return positive ? 1 : negative ? -1 : 0;
}

bool certain_rohn(const Bounds& bounds) noexcept {
  const std::size_t n = bounds.n;
  const double error = error_bound_ru(bounds);
  alignas(64) double vertex[kMaxRohn * kMaxRohn * kLanes];
  alignas(64) double minors[kMaxSets * kLanes];
  int sign = 0;
  for (std::size_t c = 0; c < std::size_t{1} << (2 * n - 1); c += kLanes) {
    fill_vertices(bounds, c, vertex);
    determinants(vertex, n, minors);
    const int now = common_sign(minors + ((std::size_t{1} << n) - 1) * kLanes, error);
    if (now == 0 || (sign != 0 && now != sign)) return false;
    sign = now;
  }
  return true;
}

}  // namespace

LaneMask certain_rohn(const double* matrix, std::size_t n, LaneMask lanes) noexcept {
  LaneMask certain = 0;
  if (n > kMaxRohn) return certain;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    if ((lanes >> lane & 1U) != 0 && certain_rohn(bounds_of_lane(matrix, n, lane)))
      certain |= 1U << lane;
  return certain;
}

}  // namespace regulus
