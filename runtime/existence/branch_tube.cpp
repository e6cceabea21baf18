// SPDX-License-Identifier: Apache-2.0
#include "runtime/existence/branch_tube.hpp"

#include <algorithm>
#include <cmath>

namespace regulus {

namespace {

/// Encloses c_i + S_i(X − x₀).
Interval middle_of(const BranchTube& tube, std::span<const Interval> box, std::size_t i) {
  Interval sum(tube.center[i]);
  for (std::size_t k = 0; k < tube.at.size(); ++k)
    sum += Interval(tube.slopes[i * tube.at.size() + k]) * (box[k] - Interval(tube.at[k]));
  return sum;
}

}  // namespace

std::vector<Interval> enclose(const BranchTube& tube, std::span<const Interval> box) {
  std::vector<Interval> unknowns;
  for (std::size_t i = 0; i < tube.center.size(); ++i)
    unknowns.push_back(middle_of(tube, box, i) + Interval(-tube.radius[i], tube.radius[i]));
  return unknowns;
}

bool certain_holds(const BranchTube& tube, std::span<const Interval> box,
                   std::span<const Interval> unknowns) {
  for (std::size_t i = 0; i < tube.center.size(); ++i)
    if (!(mag(unknowns[i] - middle_of(tube, box, i)) <= tube.radius[i])) return false;
  return true;
}

namespace {

/// Bounds of the entries of K·M: over all of Z, and of its mean along segments from the centre.
struct Bounds {
  double all = kInfinity, mean = kInfinity;
};

/// A bound that is not a number does not count.
double least(double a, double b) { return b < a || std::isnan(a) ? b : a; }

class ImageOfTube {
 public:
  ImageOfTube(const BranchTube& tube, std::span<const Interval> box,
              std::span<const double> inverse, const TubeSystem& system)
      : tube_(tube),
        inverse_(inverse),
        system_(system),
        n_(tube.center.size()),
        m_(tube.at.size()),
        is_second_order_(!system.rates_by_unknown.empty()) {
    for (std::size_t k = 0; k < m_; ++k) reach_.push_back(mag(box[k] - Interval(tube.at[k])));
    reach_.insert(reach_.end(), tube.radius.begin(), tube.radius.end());
    if (is_second_order_) find_rates();
  }

  TubeImage image() {
    image_.radius.assign(n_, 0), image_.change.assign(n_, 0);
    image_.impact.assign(n_ * m_, 0), image_.spread.assign(n_ * n_, 0);
    for (std::size_t i = 0; i < n_; ++i) {
      image_.offset.push_back(mag(combined(i, Column(system_.value.begin(), system_.value.end()))));
      image_.radius[i] = image_.offset.back();
    }
    for (std::size_t k = 0; k < m_; ++k)
      if (reach_[k] != 0) add_variable(k);
    for (std::size_t l = 0; l < n_; ++l) add_unknown(l);
    return std::move(image_);
  }

 private:
  using Column = std::vector<Interval>;
  using Matrix = std::span<const Interval>;

  /// Row i of K times a column.
  [[nodiscard]] Interval combined(std::size_t i, const Column& column) const {
    Interval sum(0.0);
    for (std::size_t j = 0; j < n_; ++j) sum += Interval(inverse_[i * n_ + j]) * column[j];
    return sum;
  }

  /// Column k of Φ_x + Φ_p S, or of a derivative of it.
  [[nodiscard]] Column along(Matrix by_variable, Matrix by_unknown, std::size_t k) const {
    Column column(n_);
    for (std::size_t j = 0; j < n_; ++j) {
      column[j] = by_variable[j * m_ + k];
      for (std::size_t q = 0; q < n_; ++q)
        column[j] += by_unknown[j * n_ + q] * Interval(tube_.slopes[q * m_ + k]);
    }
    return column;
  }
  [[nodiscard]] Column column(Matrix by_unknown, std::size_t l) const {
    Column result(n_);
    for (std::size_t j = 0; j < n_; ++j) result[j] = by_unknown[j * n_ + l];
    return result;
  }

  [[nodiscard]] Matrix rate_by_unknown(std::size_t by) const {
    return system_.rates_by_unknown.subspan(by * n_ * n_, n_ * n_);
  }
  [[nodiscard]] Matrix rate_by_variable(std::size_t by) const {
    return system_.rates_by_variable.subspan(by * n_ * m_, n_ * m_);
  }

  /// The derivatives of all columns, those of variables along the tube, where variable l moves the
  /// unknowns along, or unknown l − m alone.
  void find_rates() {
    const std::size_t all = m_ + n_;
    std::vector<Column> alone(all * all);
    for (std::size_t by = 0; by < all; ++by)
      for (std::size_t k = 0; k < all; ++k)
        alone[by * all + k] = k < m_ ? along(rate_by_variable(by), rate_by_unknown(by), k)
                                     : column(rate_by_unknown(by), k - m_);
    rates_ = alone;
    for (std::size_t l = 0; l < m_; ++l)
      for (std::size_t k = 0; reach_[l] != 0 && k < all; ++k)
        for (std::size_t i = 0; i < n_; ++i)
          for (std::size_t j = 0; j < n_; ++j)
            rates_[l * all + k][j] +=
                Interval(tube_.slopes[i * m_ + l]) * alone[(m_ + i) * all + k][j];
  }

  /// Bounds of row after row of K times column k, less 1 in row `unit`.
  [[nodiscard]] std::vector<Bounds> bounds(const Column& over, const Column& center,
                                           std::size_t unit, std::size_t k) const {
    std::vector<double> change(n_, 0.0);
    for (std::size_t l = 0; is_second_order_ && l < m_ + n_; ++l) {
      if (reach_[l] == 0) continue;
      const Column& rates = rates_[l * (m_ + n_) + k];
      for (std::size_t i = 0; i < n_; ++i)
        change[i] = add_ru(change[i], mul_ru(mag(combined(i, rates)), reach_[l]));
    }
    const auto less = [&](std::size_t i, const Column& values) {
      const Interval sum = combined(i, values);
      return mag(i == unit ? sum - Interval(1.0) : sum);
    };
    std::vector<Bounds> result(n_);
    for (std::size_t i = 0; i < n_; ++i) {
      result[i].all = result[i].mean = less(i, over);
      if (!is_second_order_) continue;
      const double at_center = less(i, center);
      result[i].all = least(result[i].all, add_ru(at_center, change[i]));
      result[i].mean = least(result[i].mean, add_ru(at_center, mul_ru(0.5, change[i])));
    }
    return result;
  }

  void add_variable(std::size_t k) {
    const Column center = is_second_order_
                              ? along(system_.center_by_variable, system_.center_by_unknown, k)
                              : Column();
    const auto found = bounds(along(system_.by_variable, system_.by_unknown, k), center, n_, k);
    for (std::size_t i = 0; i < n_; ++i) {
      image_.impact[i * m_ + k] = mul_ru(found[i].mean, reach_[k]);
      image_.radius[i] = add_ru(image_.radius[i], image_.impact[i * m_ + k]);
    }
  }

  void add_unknown(std::size_t l) {
    const Column center = is_second_order_ ? column(system_.center_by_unknown, l) : Column();
    const auto found = bounds(column(system_.by_unknown, l), center, l, m_ + l);
    for (std::size_t i = 0; i < n_; ++i) {
      image_.spread[i * n_ + l] = found[i].all;
      image_.change[i] = add_ru(image_.change[i], mul_ru(found[i].all, tube_.radius[l]));
      image_.radius[i] = add_ru(image_.radius[i], mul_ru(found[i].mean, tube_.radius[l]));
    }
  }

  const BranchTube& tube_;
  const std::span<const double> inverse_;
  const TubeSystem& system_;
  const std::size_t n_, m_;
  const bool is_second_order_;
  std::vector<double> reach_;  ///< of variables and unknowns, from the centre
  std::vector<Column> rates_;  ///< by direction l, then column k; empty: of first order
  TubeImage image_;
};

}  // namespace

TubeImage image_of(const BranchTube& tube, std::span<const Interval> box,
                   std::span<const double> inverse, const TubeSystem& system) {
  return ImageOfTube(tube, box, inverse, system).image();
}

/// A bound that is not a number fails every comparison.
bool has_one_solution(const BranchTube& tube, const TubeImage& image) {
  for (std::size_t i = 0; i < tube.radius.size(); ++i)
    if (!(image.radius[i] < tube.radius[i]) || !(image.change[i] < tube.radius[i]) ||
        !(tube.radius[i] < kInfinity))
      return false;
  return !tube.radius.empty();
}

bool approx_invert(std::span<double> a, std::span<double> inverse, std::size_t n) noexcept {
  std::ranges::fill(inverse, 0.0);
  for (std::size_t i = 0; i < n; ++i) inverse[i * n + i] = 1;
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t i = c + 1; i < n; ++i)
      if (std::abs(a[i * n + c]) > std::abs(a[pivot * n + c])) pivot = i;
    if (!(std::abs(a[pivot * n + c]) > 0)) return false;
    for (std::size_t j = 0; j < n; ++j) {
      std::swap(a[c * n + j], a[pivot * n + j]);
      std::swap(inverse[c * n + j], inverse[pivot * n + j]);
    }
    const double divisor = a[c * n + c];
    for (std::size_t j = 0; j < n; ++j) a[c * n + j] /= divisor, inverse[c * n + j] /= divisor;
    for (std::size_t i = 0; i < n; ++i) {
      const double factor = a[i * n + c];
      if (i == c || factor == 0) continue;
      for (std::size_t j = 0; j < n; ++j) {
        a[i * n + j] -= factor * a[c * n + j];
        inverse[i * n + j] -= factor * inverse[c * n + j];
      }
    }
  }
  return std::ranges::all_of(inverse, [](double x) { return std::isfinite(x); });
}

std::optional<std::vector<double>> approx_inverse_of(std::span<const double> matrix,
                                                     std::size_t n) {
  std::vector<double> a(matrix.begin(), matrix.end()), inverse(n * n);
  if (!approx_invert(a, inverse, n)) return std::nullopt;
  return inverse;
}

}  // namespace regulus
