// SPDX-License-Identifier: Apache-2.0
#include "regulus/regularity/structured.hpp"

#include <algorithm>
#include <cmath>

namespace regulus {
namespace {

/// On a cache line of its own: a store that crosses lines cannot be forwarded to the next load.
struct alignas(64) Lanes {
  double value[kLanes];
  double& operator[](std::size_t lane) noexcept { return value[lane]; }
  double operator[](std::size_t lane) const noexcept { return value[lane]; }
};

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

/// sum[j] = Σᵢ w[i]·M[i][j].
void combine(const Lanes* w, const double* M, std::size_t n, std::size_t columns,
             Lanes* sum) noexcept {
  for (std::size_t j = 0; j < columns; ++j) {
    OctetSum total;
    for (std::size_t i = 0; i < n; ++i)
      total.add_product(w[i].value, M + point_at(i * columns + j, 0));
    total.store(sum[j].value);
  }
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

  /// ≥ |wᵀE|, to be raised by the caller for n + variables + 2 terms.
  void bound(const Lanes* w, const Lanes* magnitude_of_w, Lanes* result) const noexcept {
    combine(magnitude_of_w, rest_, in_.n, in_.n, result);
    for (std::size_t slope = 0; slope < slopes_; ++slope) {
      Lanes sum[kMaxColumns];
      combine(w, in_.workspace + slope * in_.n * in_.n * kLanes, in_.n, in_.n, sum);
      for (std::size_t j = 0; j < in_.n; ++j)
        for (std::size_t lane = 0; lane < kLanes; ++lane)
          result[j][lane] += std::fabs(sum[j][lane]);
    }
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
  alignas(64) double rest_[kMaxColumns * kMaxColumns * kLanes];
};

/// How the vectors w of one row l are read off: (K∂_kA)[i][j] = K[i][l]·w_j for every i, so by way
/// of the i with the largest K[i][l].
struct RowReader {
  std::size_t entry[kLanes];
  double reciprocal[kLanes];

  RowReader(const StructuredInput& in, std::size_t row) noexcept {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const auto value = [&](std::size_t i) { return in.K[point_at(i * in.m + row, lane)]; };
      entry[lane] = 0;
      for (std::size_t i = 1; i < in.n; ++i)
        if (std::fabs(value(i)) > std::fabs(value(entry[lane]))) entry[lane] = i;
      reciprocal[lane] = 1.0 / value(entry[lane]);
    }
  }
};

/// One variable u_k that touches one row: w_k⁰, the distance of w_k from it, and what follows.
class RowTerm {
 public:
  RowTerm(const StructuredInput& input, std::size_t variable, const RowReader& reader) noexcept
      : in_(input) {
    enclose_row(variable, reader);
  }

  /// ≥ |w⁰ᵀK|, all m entries; magnitude_of_K is |K|.
  void preconditioned_ru(const double* magnitude_of_K, Lanes* bound) const noexcept {
    Lanes sum[kMaxRows];
    combine(middle_, in_.K, in_.n, in_.m, sum);
    combine(magnitude_, magnitude_of_K, in_.n, in_.m, bound);
    for (std::size_t j = 0; j < in_.m; ++j)
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        bound[j][lane] = signed_sum_ru(sum[j][lane], bound[j][lane], in_.n);
  }

  /// ≥ |w⁰ᵀE| + |w − w⁰|, all n entries.
  void defect_ru(const Defect& defect, Lanes* bound) const noexcept {
    Lanes by_P[kMaxColumns];
    combine(magnitude_, in_.P, in_.n, in_.n, by_P);
    defect.bound(middle_, magnitude_, bound);
    const double factor = raise_factor(in_.n + in_.variables + 4);
    for (std::size_t j = 0; j < in_.n; ++j)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const bool slopes_known = (in_.nominal_lanes >> lane & 1U) != 0;
        const double least =
            slopes_known && bound[j][lane] < by_P[j][lane] ? bound[j][lane] : by_P[j][lane];
        bound[j][lane] = raise_ru(least + distance_[j][lane], factor);
      }
  }

 private:
  /// Rounding: a bound times the rounded reciprocal errs by less than 2^-50 of itself and 2^-1074;
  /// K[i][l] = 0 makes everything infinite or NaN, which no test accepts.
  void enclose_row(std::size_t variable, const RowReader& reader) noexcept {
    const double factor = raise_factor(3);
    for (std::size_t j = 0; j < in_.n; ++j)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::size_t e = (variable * in_.n + reader.entry[lane]) * in_.n + j;
        const double a = in_.full[lower_at(e, lane)] * reader.reciprocal[lane];
        const double b = in_.full[upper_at(e, lane)] * reader.reciprocal[lane];
        const double w = 0.5 * a + 0.5 * b;
        const double error = (std::fabs(a) + std::fabs(b)) * 0x1p-49;
        middle_[j][lane] = w;
        magnitude_[j][lane] = std::fabs(w);
        distance_[j][lane] = raise_ru(larger(std::fabs(a - w), std::fabs(b - w)) + error, factor);
      }
  }

  const StructuredInput& in_;
  Lanes middle_[kMaxColumns];
  Lanes magnitude_[kMaxColumns];
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

/// Adds Δ_k (…) to a row of Q and R.
void add_term(const RowStructure& structure, const StructuredInput& in, const Defect& defect,
              const double* magnitude_of_K, const RowTerm& term, std::size_t k,
              double* lower_row) noexcept {
  Lanes left[kMaxColumns], right[kMaxRows];
  term.defect_ru(defect, left);
  term.preconditioned_ru(magnitude_of_K, right);
  for (std::size_t j = 0; j < in.n + structure.rows.size(); ++j) {
    const Lanes& bound = j < in.n ? left[j] : right[structure.rows[j - in.n]];
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      lower_row[point_at(j, lane)] += bound[lane] * in.radius[point_at(k, lane)];
  }
}

}  // namespace

void structured_bounds_ru(const RowStructure& structure, const StructuredInput& in,
                          double* T) noexcept {
  const std::size_t order = in.n + structure.rows.size();
  copy_upper_rows(structure, in, T);
  const Defect defect(structure, in);
  alignas(64) double magnitude_of_K[kMaxColumns * kMaxRows * kLanes];
  for (std::size_t e = 0; e < in.n * in.m * kLanes; ++e) magnitude_of_K[e] = std::fabs(in.K[e]);
  for (std::size_t slot = 0; slot < structure.rows.size(); ++slot) {
    const RowReader reader(in, structure.rows[slot]);
    double* lower_row = T + (in.n + slot) * order * kLanes;
    for (std::size_t k = 0; k < in.variables; ++k)
      if (structure.slot[k] == static_cast<int>(slot))
        add_term(structure, in, defect, magnitude_of_K, RowTerm(in, k, reader), k, lower_row);
  }
  const double factor = raise_factor(in.variables + 1);
  for (std::size_t e = in.n * order * kLanes; e < order * order * kLanes; ++e)
    T[e] = raise_ru(T[e], factor);
}

}  // namespace regulus
