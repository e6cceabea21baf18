// SPDX-License-Identifier: Apache-2.0
#include "runtime/regularity/h_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/regularity/backend.hpp"

namespace regulus {
namespace {

/// Returns x·(1 + 2^-51), which is above the exact value of one sum whose floating-point value is x
/// ≥ 0. A sum of doubles that is not zero is a multiple of 2^-1074, and here (l − 1) at least
/// 2^-53: the product cannot underflow.
double one_sum_ru(double x) noexcept { return x * (1.0 + 0x1p-51); }

}  // namespace

void distance_to_identity_ru(ConstIntervalMatrix product, PointMatrix P) noexcept {
  const std::size_t n = P.rows();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t e = i * n + j;
      const double identity = i == j ? 1.0 : 0.0;
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const double lo = std::fabs(product.lower(e, lane) - identity);
        const double hi = std::fabs(product.upper(e, lane) - identity);
        const double larger = hi > lo ? hi : lo;
        P.at(e, lane) = i == j ? one_sum_ru(larger) : larger;
      }
    }
}

void lower_to_mean_value_ru(ConstPointMatrix center, ConstIntervalMatrix derivatives,
                            ConstPointVector radius, LaneMask lanes, PointMatrix P) noexcept {
  const std::size_t entries = P.size(), variables = radius.rows();
  const double factor = raise_factor(variables + 1);
  for (std::size_t e = 0; e < entries; ++e) {
    double sum[kLanes];
    for (std::size_t lane = 0; lane < kLanes; ++lane) sum[lane] = center.at(e, lane);
    for (std::size_t k = 0; k < variables; ++k)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::size_t d = k * entries + e;
        const double lo = std::fabs(derivatives.lower(d, lane));
        const double hi = std::fabs(derivatives.upper(d, lane));
        sum[lane] += (hi > lo ? hi : lo) * radius.at(k, lane);
      }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double bound = raise_ru(sum[lane], factor);
      double& current = P.at(e, lane);
      if (has_lane(lanes, lane) && bound < current) current = bound;
    }
  }
}

LaneMask certain_contraction(ConstPointMatrix P, ConstPointVector v) noexcept {
  const std::size_t n = P.rows();
  const double factor = raise_factor(n);
  LaneMask certain = kAllLanes;
  alignas(64) double sum[kMaxOrder * kLanes];
  regularity_backend().multiply(P, v, PointVector(sum, n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double vi = v.at(i, lane);
      // The condition is false for NaN. It is false for infinite v: Pv < v then has no meaning.
      const bool holds = vi > 0.0 && vi < std::numeric_limits<double>::infinity() &&
                         raise_ru(sum[point_at(i, lane)], factor) < vi;
      certain &= ~(static_cast<LaneMask>(!holds) << lane);
    }
  }
  return certain;
}

LaneMask certain_h_matrix(ConstPointMatrix P, PointVector v) noexcept {
  regularity_backend().solve_for_ones(P, v);
  return certain_contraction(P, v);
}

LaneNumbers determinant_ru(ConstPointMatrix P, ConstPointVector v) noexcept {
  const std::size_t n = P.rows();
  const double factor = raise_factor(n);
  LaneNumbers upper;
  for (std::size_t lane = 0; lane < kLanes; ++lane) upper[lane] = 1.0;
  alignas(64) double sum[kMaxOrder * kLanes];
  regularity_backend().multiply(P, v, PointVector(sum, n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double ratio =
          raise_ru(raise_ru(sum[point_at(i, lane)], factor) / v.at(i, lane), factor);
      upper[lane] = raise_ru(upper[lane] * raise_ru(1.0 + ratio, factor), factor);
    }
  }
  return upper;
}

LaneNumbers approx_perron(ConstPointMatrix P, PerronVectors vectors) noexcept {
  LaneNumbers radius;
  regularity_backend().perron(P, vectors, radius);
  return radius;
}

}  // namespace regulus
