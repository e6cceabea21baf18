// SPDX-License-Identifier: Apache-2.0
// What follows from the bounds of second_order_bounds.cpp besides T itself.
#include <algorithm>
#include <cmath>

#include "regulus/interval/elementary.hpp"
#include "regulus/regularity/h_matrix.hpp"
#include "regulus/regularity/second_order.hpp"

namespace regulus {
namespace {

constexpr double kGamma = (64 + 4) * 0x1p-50;

/// Σ_i y_i·M_ij·v_j, where y and v are rows of octets.
void add_form(Octet& sum, const Octet* y, const OctetMatrix& M, const Octet* v) noexcept {
  for (std::size_t i = 0; i < M.rows(); ++i) {
    Octet row{};
    for (std::size_t j = 0; j < M.columns(); ++j) add_product(row, M(i, j), v[j]);
    add_product(sum, y[i], row);
  }
}

}  // namespace

/// yᵀTv falls into the parts of single variables, once Q = weight·P + rest is put through P.
void SecondOrderBounds::approx_impact(const double* v, const double* y, double* impact) noexcept {
  const std::size_t n = columns_, slots = touched_.size();
  Octet right[kMaxOrder], left[kMaxOrder];
  for (std::size_t i = 0; i < order(); ++i) {
    std::memcpy(right[i].value, v + point_at(i, 0), sizeof(Octet));
    std::memcpy(left[i].value, y + point_at(i, 0), sizeof(Octet));
  }
  const Octet* left_low = left + n;
  // Before the lower rows' weights are added: y of the upper right block alone.
  Octet left_up[kMaxColumns];
  std::copy_n(left, n, left_up);
  for (std::size_t s = 0; s < slots; ++s)
    for (std::size_t i = 0; i < n; ++i) {
      add_product(left[i], left_low[s], weight_(s, i));
      add_product(left[i], left_low[s], weight_of_g_(s, i));
    }
  for (std::size_t k = 0; k < radius_.size(); ++k)
    std::fill_n(impact + point_at(k, 0), kLanes, 0.0);
  for (const WideVariable& w : wide_) {
    Octet sum{};
    add_form(sum, left, w.defect, right);
    add_form(sum, left_low, w.R, right + n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t s = 0; s < slots; ++s) {
        Octet moved{};
        add_magnitude(moved, w.DK(i, touched_[s]), radius_[w.variable]);
        for (std::size_t l = 0; l < kLanes; ++l)
          sum[l] += left_up[i][l] * moved[l] * right[n + s][l];
      }
    std::memcpy(impact + point_at(w.variable, 0), sum.value, sizeof(Octet));
  }
  for (const RowVariable& u : row_variables_) {
    Octet sum{};
    add_form(sum, left_low + u.slot, u.R, right + n);
    std::memcpy(impact + point_at(u.variable, 0), sum.value, sizeof(Octet));
  }
}

/// det K(t)/det K₀ = det(I + X), X = −Σ_p τ_pD_p, |X| ≤ Σ_p r_p|D_p|. A diagonal similarity of X
/// changes neither trace nor determinant.
void SecondOrderBounds::moving_determinant_ru(double* upper) const noexcept {
  const std::size_t n = columns_;
  alignas(64) double G[kMaxColumns * kMaxColumns * kLanes];
  double v[kMaxColumns * kLanes], y[kMaxColumns * kLanes], radius[kLanes];
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      std::memcpy(G + point_at(i * n + j, 0), sum_D_(i, j).value, sizeof(Octet));
  approx_perron(G, n, v, y, radius);
  const double factor = raise_factor(4 * n * n + 4 * wide_.size());
  for (std::size_t l = 0; l < kLanes; ++l) {
    double trace = 0.0, square = 0.0, scale[kMaxColumns];
    for (const WideVariable& w : wide_) {
      double sum = 0.0;
      for (std::size_t i = 0; i < n; ++i) sum += w.D(i, i)[l];
      trace += std::fabs(sum) * radius_[w.variable][l];
    }
    for (std::size_t i = 0; i < n; ++i) {
      trace += kGamma * sum_D_(i, i)[l];
      const double ratio = v[point_at(i, l)] / y[point_at(i, l)];
      scale[i] = ratio > 0x1p-100 && ratio < 0x1p100 ? std::sqrt(ratio) : 1.0;
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const double x = sum_D_(i, j)[l] * scale[j] / scale[i];
        square += x * x;
      }
    const double square_ru = raise_ru(square, factor);
    const double norm = raise_ru(std::sqrt(square_ru), factor);
    const double rest = raise_ru(square_ru / (2.0 * (1.0 - norm)), factor);
    const double logarithm = raise_ru(raise_ru(trace, factor) + rest, factor);
    upper[l] = norm < 0.5 ? exp(Interval(logarithm)).hi : HUGE_VAL;
  }
}

}  // namespace regulus
