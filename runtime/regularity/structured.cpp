// SPDX-License-Identifier: Apache-2.0
#include "regulus/regularity/structured.hpp"

#include <algorithm>
#include <cmath>

namespace regulus {
namespace {

using Lanes = double[kLanes];

double larger(double a, double b) noexcept { return b > a ? b : a; }

/// |s| from its floating-point value and that of the sum of its terms' magnitudes.
///
/// Rounding  a signed sum of `terms` products errs by at most 2tu·Σ|aᵢbᵢ| with u = 2^-52, and by
///           underflows: see raise_ru, whose notation this is. (t + 4)·2^-50 exceeds 2tu by a
///           factor that covers the rounding of Σ|aᵢbᵢ| itself.
double signed_sum_ru(double sum, double magnitudes, std::size_t terms) noexcept {
  const double error = magnitudes * (static_cast<double>(terms + 4) * 0x1p-50);
  return raise_ru(std::fabs(sum) + error, raise_factor(terms));
}

/// E = (KA(t₀, u₀) − I) + Σ_p K∂_pA·(t_p − t₀_p), prepared for |wᵀE|_j ≤ Σ_p |Σᵢ wᵢ·M_p[i][j]| + Σᵢ
/// |wᵢ|·S[i][j]: M_p is the middle of K∂_pA times r_p, S collects all the rest.
class Defect {
 public:
  Defect(const RowStructure& structure, const StructuredInput& in) noexcept : in_(in) {
    const std::size_t entries = in.n * in.n;
    std::copy_n(in.center, entries * kLanes, rest_);
    for (std::size_t p = 0; p < in.variables; ++p)
      if (!structure.touches_one_row(p)) add_slope(p);
    const double factor = raise_factor(in.variables + 2);
    for (std::size_t e = 0; e < entries * kLanes; ++e) rest_[e] = raise_ru(rest_[e], factor);
  }

  /// ≥ |wᵀE|, entry j, to be raised by the caller for n + variables + 2 terms.
  void bound(const Lanes* w, std::size_t j, Lanes& result) const noexcept {
    weigh(rest_, w, j, result);
    for (std::size_t slope = 0; slope < slopes_; ++slope) {
      const double* middle = in_.workspace + slope * in_.n * in_.n * kLanes;
      Lanes sum = {};
      for (std::size_t i = 0; i < in_.n; ++i)
        for (std::size_t lane = 0; lane < kLanes; ++lane)
          sum[lane] += w[i][lane] * middle[point_at(i * in_.n + j, lane)];
      for (std::size_t lane = 0; lane < kLanes; ++lane) result[lane] += std::fabs(sum[lane]);
    }
  }

  /// Σᵢ |wᵢ|·M[i][j].
  void weigh(const double* M, const Lanes* w, std::size_t j, Lanes& sum) const noexcept {
    for (std::size_t lane = 0; lane < kLanes; ++lane) sum[lane] = 0.0;
    for (std::size_t i = 0; i < in_.n; ++i)
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        sum[lane] += std::fabs(w[i][lane]) * M[point_at(i * in_.n + j, lane)];
  }

 private:
  /// Rounding: M_p errs by 2^-52 of itself, and n products with it are summed later on, with the
  /// error that signed_sum_ru allows for; both are charged to the rest.
  void add_slope(std::size_t p) noexcept {
    const std::size_t entries = in_.n * in_.n;
    const double loss = static_cast<double>(in_.n + 4) * 0x1p-50 + 0x1p-51;
    const double factor = raise_factor(4);
    double* middle = in_.workspace + slopes_++ * entries * kLanes;
    for (std::size_t e = 0; e < entries; ++e)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const double lo = in_.nominal[lower_at(p * entries + e, lane)];
        const double hi = in_.nominal[upper_at(p * entries + e, lane)];
        const double r = in_.radius[point_at(p, lane)];
        const double m = 0.5 * lo + 0.5 * hi;
        const double scaled = m * r;
        middle[point_at(e, lane)] = scaled;
        rest_[point_at(e, lane)] +=
            raise_ru(larger(hi - m, m - lo) * r + std::fabs(scaled) * loss, factor);
      }
  }

  const StructuredInput& in_;
  std::size_t slopes_ = 0;
  double rest_[kMaxColumns * kMaxColumns * kLanes];
};

/// One variable u_k that touches one row: w_k⁰, the distance of w_k from it, and what follows.
class RowTerm {
 public:
  RowTerm(const StructuredInput& input, std::size_t variable, std::size_t row) noexcept
      : in_(input) {
    choose_entry(row);
    enclose_row(variable, row);
  }

  /// ≥ |w⁰ᵀK|, entry `column`.
  void preconditioned_ru(std::size_t column, Lanes& bound) const noexcept {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      double sum = 0.0, magnitudes = 0.0;
      for (std::size_t i = 0; i < in_.n; ++i) {
        const double term = middle_[i][lane] * in_.K[point_at(i * in_.m + column, lane)];
        sum += term;
        magnitudes += std::fabs(term);
      }
      bound[lane] = signed_sum_ru(sum, magnitudes, in_.n);
    }
  }

  /// ≥ |w⁰ᵀE| + |w − w⁰|, entry j.
  void defect_ru(const Defect& defect, std::size_t j, Lanes& bound) const noexcept {
    Lanes by_P, by_slope;
    defect.weigh(in_.P, middle_, j, by_P);
    defect.bound(middle_, j, by_slope);
    const double factor = raise_factor(in_.n + in_.variables + 4);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const bool slopes_known = (in_.nominal_lanes >> lane & 1U) != 0;
      const double least =
          slopes_known && by_slope[lane] < by_P[lane] ? by_slope[lane] : by_P[lane];
      bound[lane] = raise_ru(least + distance_[j][lane], factor);
    }
  }

 private:
  /// (K∂_kA)[i][j] = K[i][l]·w_j for every i: w is read off where K[i][l] is largest.
  void choose_entry(std::size_t row) noexcept {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const auto size = [&](std::size_t i) {
        return std::fabs(in_.K[point_at(i * in_.m + row, lane)]);
      };
      entry_[lane] = 0;
      for (std::size_t i = 1; i < in_.n; ++i)
        if (size(i) > size(entry_[lane])) entry_[lane] = i;
    }
  }

  /// Rounding: a quotient errs by at most 2^-52 of itself and 2^-1074, as do the differences;
  /// K[i][l] = 0 makes everything NaN, which no test accepts.
  void enclose_row(std::size_t variable, std::size_t row) noexcept {
    for (std::size_t j = 0; j < in_.n; ++j)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::size_t i = entry_[lane];
        const double k = in_.K[point_at(i * in_.m + row, lane)];
        const std::size_t e = (variable * in_.n + i) * in_.n + j;
        const double a = in_.full[lower_at(e, lane)] / k;
        const double b = in_.full[upper_at(e, lane)] / k;
        const double w = 0.5 * a + 0.5 * b;
        const double error = (std::fabs(a) + std::fabs(b)) * 0x1p-51;
        middle_[j][lane] = w;
        distance_[j][lane] =
            raise_ru(larger(std::fabs(a - w), std::fabs(b - w)) + error, raise_factor(2));
      }
  }

  const StructuredInput& in_;
  std::size_t entry_[kLanes];
  Lanes middle_[kMaxColumns];
  Lanes distance_[kMaxColumns];
};

void copy_upper_rows(const RowStructure& structure, const StructuredInput& in, double* T) noexcept {
  const std::size_t order = in.n + structure.rows.size();
  std::fill_n(T, order * order * kLanes, 0.0);
  for (std::size_t i = 0; i < in.n; ++i) {
    std::copy_n(in.P + i * in.n * kLanes, in.n * kLanes, T + i * order * kLanes);
    for (std::size_t s = 0; s < structure.rows.size(); ++s)
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        T[point_at(i * order + in.n + s, lane)] =
            std::fabs(in.K[point_at(i * in.m + structure.rows[s], lane)]);
  }
}

}  // namespace

void structured_bounds_ru(const RowStructure& structure, const StructuredInput& in,
                          double* T) noexcept {
  const std::size_t order = in.n + structure.rows.size();
  copy_upper_rows(structure, in, T);
  const Defect defect(structure, in);
  for (std::size_t k = 0; k < in.variables; ++k) {
    if (!structure.touches_one_row(k)) continue;
    const auto slot = static_cast<std::size_t>(structure.slot[k]);
    const RowTerm term(in, k, structure.rows[slot]);
    double* target = T + (in.n + slot) * order * kLanes;
    for (std::size_t j = 0; j < order; ++j) {
      Lanes bound;
      if (j < in.n)
        term.defect_ru(defect, j, bound);
      else
        term.preconditioned_ru(structure.rows[j - in.n], bound);
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        target[point_at(j, lane)] += bound[lane] * in.radius[point_at(k, lane)];
    }
  }
  const double factor = raise_factor(in.variables + 1);
  for (std::size_t e = in.n * order * kLanes; e < order * order * kLanes; ++e)
    T[e] = raise_ru(T[e], factor);
}

}  // namespace regulus
