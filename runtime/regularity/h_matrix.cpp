// SPDX-License-Identifier: Apache-2.0
#include "regulus/regularity/h_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "regulus/regularity/backend.hpp"

namespace regulus {
namespace {

/// x·(1 + 2^-51): above the exact value of one sum whose floating-point value is x ≥ 0. A sum of
/// doubles that is not zero is a multiple of 2^-1074, and here (l − 1) at least 2^-53: the product
/// cannot underflow.
double one_sum_ru(double x) noexcept { return x * (1.0 + 0x1p-51); }

}  // namespace

void distance_to_identity_ru(const double* product, std::size_t n, double* P) noexcept {
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t e = i * n + j;
      const double identity = i == j ? 1.0 : 0.0;
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const double lo = std::fabs(product[lower_at(e, lane)] - identity);
        const double hi = std::fabs(product[upper_at(e, lane)] - identity);
        const double larger = hi > lo ? hi : lo;
        P[point_at(e, lane)] = i == j ? one_sum_ru(larger) : larger;
      }
    }
}

void lower_to_mean_value_ru(const double* center, const double* derivatives, const double* radius,
                            std::size_t n, std::size_t variables, LaneMask lanes,
                            double* P) noexcept {
  const double factor = raise_factor(variables + 1);
  for (std::size_t e = 0; e < n * n; ++e) {
    double sum[kLanes];
    for (std::size_t lane = 0; lane < kLanes; ++lane) sum[lane] = center[point_at(e, lane)];
    for (std::size_t k = 0; k < variables; ++k)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::size_t d = k * n * n + e;
        const double lo = std::fabs(derivatives[lower_at(d, lane)]);
        const double hi = std::fabs(derivatives[upper_at(d, lane)]);
        sum[lane] += (hi > lo ? hi : lo) * radius[point_at(k, lane)];
      }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double bound = raise_ru(sum[lane], factor);
      double& current = P[point_at(e, lane)];
      if ((lanes >> lane & 1U) != 0 && bound < current) current = bound;
    }
  }
}

LaneMask certain_contraction(const double* P, const double* v, std::size_t n) noexcept {
  const double factor = raise_factor(n);
  LaneMask certain = kAllLanes;
  alignas(64) double sum[kMaxOrder * kLanes];
  regularity_backend().multiply(P, v, static_cast<unsigned>(n), sum);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double vi = v[point_at(i, lane)];
      // Written so that NaN fails; an infinite v fails because Pv < v then has no meaning.
      const bool holds = vi > 0.0 && vi < std::numeric_limits<double>::infinity() &&
                         raise_ru(sum[point_at(i, lane)], factor) < vi;
      certain &= ~(static_cast<LaneMask>(!holds) << lane);
    }
  }
  return certain;
}

LaneMask certain_h_matrix(const double* P, std::size_t n, double* v) noexcept {
  regularity_backend().solve_for_ones(P, static_cast<unsigned>(n), v);
  return certain_contraction(P, v, n);
}

void determinant_ru(const double* P, const double* v, std::size_t n, double* upper) noexcept {
  const double factor = raise_factor(n);
  for (std::size_t lane = 0; lane < kLanes; ++lane) upper[lane] = 1.0;
  alignas(64) double sum[kMaxOrder * kLanes];
  regularity_backend().multiply(P, v, static_cast<unsigned>(n), sum);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double ratio =
          raise_ru(raise_ru(sum[point_at(i, lane)], factor) / v[point_at(i, lane)], factor);
      upper[lane] = raise_ru(upper[lane] * raise_ru(1.0 + ratio, factor), factor);
    }
  }
}

void approx_perron(const double* P, std::size_t n, double* v, double* y,
                   double* approx_radius) noexcept {
  regularity_backend().perron(P, static_cast<unsigned>(n), v, y, approx_radius);
}

}  // namespace regulus
