// SPDX-License-Identifier: Apache-2.0
// The sums are in second_order_lanes.hpp.
#include "runtime/regularity/second_order.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/interval/elementary.hpp"
#include "runtime/regularity/h_matrix.hpp"

namespace regulus::detail {

SecondOrderBounds::SecondOrderBounds(const DerivativeLists& lists, const RowStructure& structure,
                                     const SecondOrderOptions& options,
                                     const RegularityBackend& backend)
    : backend_(backend),
      lists_(lists, structure),
      numbers_(lists_.packs() * kLanes),
      plan_(lists_.plan()),
      work_(lists_.work(numbers_)) {
  while (plan_.moving > 0 && plan_.wide[plan_.moving - 1].variable >= options.moving)
    --plan_.moving;
  plan_.keeps_shares = options.keeps_shares;
  plan_.weighs_row_variables = options.weighs_row_variables;
}

void SecondOrderBounds::bound_ru(const SecondOrderInput& input, PointMatrix T) noexcept {
  backend_.bound_second_order(plan_, input, work_, T);
}

void SecondOrderBounds::approx_impact(const SecondOrderInput& input, PerronVectors vectors,
                                      PointVector impact) const noexcept {
  std::fill_n(impact.data(), lists_.variables() * kLanes, 0.0);
  backend_.weigh_second_order(plan_, input, work_, vectors, impact);
}

/// det K(t)/det K₀ = det(I + X), X = −Σ_p τ_pD_p, |X| ≤ Σ_p r_p|D_p|. A diagonal similarity of X
/// changes neither trace nor determinant.
LaneNumbers SecondOrderBounds::moving_determinant_ru(const SecondOrderInput& input) const noexcept {
  const std::size_t n = plan_.columns_of_A;
  const ConstPointMatrix sum_D(work_.sum_D.x, n, n);
  double right[kMaxColumns * kLanes], left[kMaxColumns * kLanes];
  const PointVector v(right, n), y(left, n);
  static_cast<void>(approx_perron(sum_D, {.right = v, .left = y}));
  LaneNumbers upper;
  const double factor = raise_factor(4 * n * n + 4 * plan_.wides);
  for (std::size_t l = 0; l < kLanes; ++l) {
    double trace = 0.0, square = 0.0, scale[kMaxColumns];
    for (std::size_t p = 0; p < plan_.wides; ++p) {
      const SecondOrderPlan::Wide& wide = plan_.wide[p];
      double sum = 0.0;
      for (std::size_t c = 0; c < wide.columns.size(); ++c) {
        const std::size_t i = plan_.columns[wide.columns.begin + c];
        sum += work_.D.x[point_at((p * n + i) * n + i, l)];
      }
      trace += std::fabs(sum) * input.radius.at(wide.variable, l);
    }
    for (std::size_t i = 0; i < n; ++i) {
      trace += kSecondOrderGamma * sum_D.at(i * n + i, l);
      const double ratio = v.at(i, l) / y.at(i, l);
      scale[i] = ratio > 0x1p-100 && ratio < 0x1p100 ? std::sqrt(ratio) : 1.0;
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const double x = sum_D.at(i * n + j, l) * scale[j] / scale[i];
        square += x * x;
      }
    const double square_ru = raise_ru(square, factor);
    const double norm = raise_ru(std::sqrt(square_ru), factor);
    const double rest = raise_ru(square_ru / (2.0 * (1.0 - norm)), factor);
    const double logarithm = raise_ru(raise_ru(trace, factor) + rest, factor);
    upper[l] = norm < 0.5 ? exp(Interval(logarithm)).hi : HUGE_VAL;
  }
  return upper;
}

}  // namespace regulus::detail
