// SPDX-License-Identifier: Apache-2.0
#include "runtime/regularity/h_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/regularity/backend.hpp"

namespace regulus::detail {
void distance_to_identity_ru(ConstIntervalMatrix product, PointMatrix P) noexcept {
  regularity_backend().distance_to_identity(product, P);
}

void lower_to_mean_value_ru(ConstPointMatrix center, ConstIntervalMatrix derivatives,
                            ConstPointVector radius, LaneMask lanes, PointMatrix P) noexcept {
  MeanValueInput input{center, derivatives, radius, raise_factor(radius.rows() + 1), {}};
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    input.more[lane] = has_lane(lanes, lane) ? 0.0 : std::numeric_limits<double>::infinity();
  regularity_backend().lower_to_mean_value(input, P);
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

}  // namespace regulus::detail
