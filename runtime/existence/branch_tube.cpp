// SPDX-License-Identifier: Apache-2.0
#include "runtime/existence/branch_tube.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {

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

/// Columns of intervals [−neg, hi], each as its n lower ends, negated, and its n upper ends. In the
/// mode upward every operation of the processor rounds both outward.
class Columns {
 public:
  Columns(std::size_t count, std::size_t n) : n_(n), ends_(2 * count * n, 0.0) {}

  [[nodiscard]] double* neg(std::size_t column) { return ends_.data() + 2 * column * n_; }
  [[nodiscard]] double* hi(std::size_t column) { return neg(column) + n_; }
  void set(std::size_t column, std::size_t row, const Interval& x) {
    neg(column)[row] = -x.lo, hi(column)[row] = x.hi;
  }
  /// Sets all columns of a matrix with n rows of `count` entries.
  void set(std::span<const Interval> matrix, std::size_t count, std::size_t from = 0) {
    for (std::size_t j = 0; j < n_ && !matrix.empty(); ++j)
      for (std::size_t k = 0; k < count; ++k) set(from + k, j, matrix[j * count + k]);
  }

  /// Adds a multiple of a column. A factor 0 makes unbounded ends 0.
  void add(std::size_t to, double factor, Columns& other, std::size_t from) {
    if (factor == 0) return;
    const double size = std::fabs(factor);
    const double* const of_neg = factor > 0 ? other.neg(from) : other.hi(from);
    const double* const of_hi = factor > 0 ? other.hi(from) : other.neg(from);
    double *const x = neg(to), *const y = hi(to);
    for (std::size_t j = 0; j < n_; ++j) x[j] += size * of_neg[j];
    for (std::size_t j = 0; j < n_; ++j) y[j] += size * of_hi[j];
  }

 private:
  const std::size_t n_;
  std::vector<double> ends_;
};

/// A bound that is not a number does not count.
double least(double a, double b) { return b < a || std::isnan(a) ? b : a; }

/// 0 times an unbounded bound is 0.
double times(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }

class ImageOfTube {
 public:
  ImageOfTube(const BranchTube& tube, std::span<const Interval> box,
              std::span<const double> inverse, const TubeSystem& system)
      : tube_(tube),
        system_(system),
        n_(tube.center.size()),
        m_(tube.at.size()),
        is_second_order_(!system.rates_by_unknown.empty()),
        inverse_(n_ * n_),
        sum_(1, n_),
        over_(m_ + n_, n_),
        center_(m_ + n_, n_),
        rates_(is_second_order_ ? (m_ + n_) * (m_ + n_) : 0, n_) {
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = 0; j < n_; ++j) inverse_[j * n_ + i] = inverse[i * n_ + j];
    for (std::size_t k = 0; k < m_; ++k) reach_.push_back(mag(box[k] - Interval(tube.at[k])));
    reach_.insert(reach_.end(), tube.radius.begin(), tube.radius.end());
  }

  /// In the mode upward.
  [[gnu::noinline]] void run() {
    image_.radius.assign(n_, 0), image_.change.assign(n_, 0), image_.offset.assign(n_, 0);
    image_.impact.assign(n_ * m_, 0), image_.spread.assign(n_ * n_, 0);
    for (std::size_t i = 0; i < n_; ++i) sum_.set(0, i, system_.value[i]);
    combine(sum_, 0, n_, image_.offset);
    image_.radius = image_.offset;
    set(over_, system_.by_variable, system_.by_unknown);
    if (is_second_order_) {
      set(center_, system_.center_by_variable, system_.center_by_unknown);
      find_rates();
    }
    for (std::size_t k = 0; k < m_; ++k)
      if (reach_[k] != 0) add_variable(k);
    for (std::size_t l = 0; l < n_; ++l) add_unknown(l);
  }
  [[nodiscard]] TubeImage image() { return std::move(image_); }

 private:
  using Matrix = std::span<const Interval>;
  using Bounds = std::vector<double>;

  /// Returns the magnitudes of K times a column, less 1 in row `unit`.
  void combine(Columns& columns, std::size_t column, std::size_t unit, Bounds& magnitudes) {
    neg_.assign(n_, 0.0), hi_.assign(n_, 0.0);
    for (std::size_t j = 0; j < n_; ++j) {
      const double* const k = inverse_.data() + j * n_;
      const double neg = columns.neg(column)[j], hi = columns.hi(column)[j];
      if (neg == 0 && hi == 0) continue;
      for (std::size_t i = 0; i < n_; ++i) {
        const double of_neg = k[i] > 0 ? neg : k[i] < 0 ? hi : 0.0;
        const double of_hi = k[i] > 0 ? hi : k[i] < 0 ? neg : 0.0;
        neg_[i] += std::fabs(k[i]) * of_neg;
        hi_[i] += std::fabs(k[i]) * of_hi;
      }
    }
    if (unit < n_) neg_[unit] += 1.0, hi_[unit] -= 1.0;
    for (std::size_t i = 0; i < n_; ++i) magnitudes[i] = neg_[i] > hi_[i] ? neg_[i] : hi_[i];
  }

  /// The columns of Φ_x + Φ_p S, and of Φ_p, or of a derivative of both.
  void set(Columns& columns, Matrix by_variable, Matrix by_unknown, std::size_t from = 0) {
    columns.set(by_variable, m_, from);
    columns.set(by_unknown, n_, from + m_);
    for (std::size_t k = 0; k < m_; ++k)
      for (std::size_t q = 0; q < n_; ++q)
        columns.add(from + k, tube_.slopes[q * m_ + k], columns, from + m_ + q);
  }

  /// The derivatives of all columns, where variable l moves the unknowns along, or unknown l − m
  /// alone. Those by a variable need those by the unknowns as they are.
  void find_rates() {
    const std::size_t all = m_ + n_;
    for (std::size_t by = 0; by < all; ++by)
      set(rates_, system_.rates_by_variable.subspan(by * n_ * m_, n_ * m_),
          system_.rates_by_unknown.subspan(by * n_ * n_, n_ * n_), by * all);
    for (std::size_t l = 0; l < m_; ++l)
      for (std::size_t k = 0; reach_[l] != 0 && k < all; ++k)
        for (std::size_t i = 0; i < n_; ++i)
          rates_.add(l * all + k, tube_.slopes[i * m_ + l], rates_, (m_ + i) * all + k);
  }

  /// Bounds row after row of K times column k, less 1 in row `unit`: over all of Z, and of its mean
  /// along segments from the centre.
  void bound(std::size_t k, std::size_t unit) {
    all_.assign(n_, 0.0), mean_.assign(n_, 0.0);
    combine(over_, k, unit, all_);
    mean_ = all_;
    if (!is_second_order_) return;
    change_.assign(n_, 0.0), magnitudes_.assign(n_, 0.0);
    for (std::size_t l = 0; l < m_ + n_; ++l) {
      if (reach_[l] == 0) continue;
      combine(rates_, l * (m_ + n_) + k, n_, magnitudes_);
      for (std::size_t i = 0; i < n_; ++i) change_[i] += times(magnitudes_[i], reach_[l]);
    }
    combine(center_, k, unit, magnitudes_);
    for (std::size_t i = 0; i < n_; ++i) {
      all_[i] = least(all_[i], magnitudes_[i] + change_[i]);
      mean_[i] = least(mean_[i], magnitudes_[i] + 0.5 * change_[i]);
    }
  }

  void add_variable(std::size_t k) {
    bound(k, n_);
    for (std::size_t i = 0; i < n_; ++i) {
      image_.impact[i * m_ + k] = times(mean_[i], reach_[k]);
      image_.radius[i] += image_.impact[i * m_ + k];
    }
  }

  void add_unknown(std::size_t l) {
    bound(m_ + l, l);
    for (std::size_t i = 0; i < n_; ++i) {
      image_.spread[i * n_ + l] = all_[i];
      image_.change[i] += times(all_[i], tube_.radius[l]);
      image_.radius[i] += times(mean_[i], tube_.radius[l]);
    }
  }

  const BranchTube& tube_;
  const TubeSystem& system_;
  const std::size_t n_, m_;
  const bool is_second_order_;
  std::vector<double> inverse_;  ///< K, column by column
  std::vector<double> reach_;    ///< of variables and unknowns, from the centre
  Columns sum_, over_, center_;
  Columns rates_;  ///< by direction l, then column k
  Bounds neg_, hi_, magnitudes_, change_, all_, mean_;
  TubeImage image_;
};

}  // namespace

TubeImage image_of(const BranchTube& tube, std::span<const Interval> box,
                   std::span<const double> inverse, const TubeSystem& system) {
  ImageOfTube image(tube, box, inverse, system);
  {
    const FloatingPointScope scope(FloatingPointRounding::kUpward);
    image.run();
  }
  return image.image();
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

}  // namespace regulus::detail
