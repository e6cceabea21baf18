// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/condition_test.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "codegen/question/condition/entry_bounds.hpp"
#include "codegen/question/condition/extreme_values.hpp"

namespace regulus::detail {
namespace {

using Doubles = std::vector<double>;

constexpr int kNewtonSteps = 40;

/// A sum to nearest of numbers of both signs, with a bound of its error.
class RoundSum {
 public:
  /// Adds a term; `size`: the sum of the magnitudes of the products that it is made of. Each of
  /// these has at most five factors that were rounded once.
  void add(double term, double size) {
    sum_ += term;
    size_ += size;
    ++terms_;
  }
  void add(double term) { add(term, std::fabs(term)); }

  /// Each partial sum is at most the sum of all sizes.
  [[nodiscard]] bool is_certainly_negative() const {
    return sum_ + static_cast<double>(terms_ + 16) * 0x1p-51 * size_ + 1e-290 < 0;
  }

 private:
  double sum_ = 0, size_ = 0;
  int terms_ = 0;
};

/// Bounds κ over one box.
class BoxCondition {
 public:
  explicit BoxCondition(const RotatedBox& box)
      : box_(box), m_(box.rows), n_(box.columns), p_(box.radius.size()), entries_(box) {}

  ConditionBound run() {
    ConditionBound result;
    bound_discs(false);
    bool is_found = find_ratio();
    const double separate = is_found ? ratio_ : kInfinity;
    bound_discs(true);
    is_found = find_ratio();
    if (separate < (is_found ? ratio_ : kInfinity)) {
      bound_discs(false);
      is_found = find_ratio();
    }
    for (std::size_t k = 0; k < p_; ++k) {
      result.impact.push_back(impact_of(k));
      result.growth.push_back(g(k, 0) / d(0) - g(k, n_ - 1) / d(n_ - 1));
    }
    if (!is_found || !proves_ratio()) return result;
    const double upper = n_ == 1 ? next_up(1.0) : mul_ru(ratio_, box_.distortion.ratio);
    if (upper >= 1) result.upper = upper;
    return result;
  }

 private:
  [[nodiscard]] double d(std::size_t i) const { return box_.center.middle[i * n_ + i]; }
  [[nodiscard]] double g(std::size_t k, std::size_t i) const {
    return box_.slopes[k].middle[i * n_ + i];
  }

  /// The weights let the discs beside the extreme ones reach as far as these. If they `share` the
  /// change of the other extreme value with δ, this leaves out what both have in common, which suits
  /// small boxes.
  void bound_discs(bool share) {
    const double ratio = d(0) / d(n_ - 1);
    Reach high{Doubles(n_), Doubles(n_)}, low = high;
    for (std::size_t i = 0; i < n_; ++i) {
      high.farthest[i] = high.goal[i] = d(i) + entries_.error[i];
      low.farthest[i] = low.goal[i] = d(i) - entries_.error[i];
      for (std::size_t k = 0; k < p_; ++k) {
        const double most = g(k, 0) / ratio, least = ratio * g(k, n_ - 1), r = box_.radius[k];
        high.farthest[i] += std::fabs(g(k, i)) * r;
        low.farthest[i] -= std::fabs(g(k, i)) * r;
        high.goal[i] += (std::fabs(g(k, i) - least) - (share ? std::fabs(least) : 0)) * r;
        low.goal[i] -= (std::fabs(most - g(k, i)) - (share ? std::fabs(most) : 0)) * r;
      }
    }
    values_.emplace(entries_.off, m_, n_, high, low);
    top_ = values_->highest().front();
    low_ = values_->lowest()[n_ - 1];
    ratio_ = 1;
  }

  /// Finds T, approximately; false if there is none.
  [[nodiscard]] bool find_ratio() {
    for (const Disc& top : values_->highest())
      for (const Disc& low : values_->lowest())
        if (!raise_ratio(top, low)) return false;
    return true;
  }

  /// Newton's method from the left, up to the zero.
  [[nodiscard]] bool raise_ratio(const Disc& top, const Disc& low) {
    const std::size_t i = top.index, l = low.index;
    const double highest = top.alpha * (d(i) + entries_.error[i]) + top.beta;
    const double lowest = low.alpha * (d(l) - entries_.error[l]) - low.beta;
    for (int step = 0; step < kNewtonSteps; ++step) {
      double value = highest - ratio_ * lowest, slope = -lowest;
      for (std::size_t k = 0; k < p_; ++k) {
        const double a = top.alpha * g(k, i), b = low.alpha * g(k, l), r = box_.radius[k];
        const double difference = a - ratio_ * b;
        value += std::fabs(difference) * r;
        slope += (difference > 0 ? -b : b) * r;
      }
      if (!(value > 0)) return !std::isnan(value);
      const double next = ratio_ - value / slope;
      if (!(slope < 0) || !std::isfinite(next)) return false;
      if (top.alpha > 0) top_ = top, low_ = low;
      if (!(next > ratio_ * (1 + 1e-15))) return true;
      ratio_ = next;
    }
    return true;
  }

  /// Proves the inequalities with a T that may be a little larger.
  [[nodiscard]] bool proves_ratio() {
    const auto& lowest = values_->lowest();
    if (!std::ranges::all_of(lowest, [&](const Disc& low) { return is_positive(low); }))
      return false;
    for (const double more : {1e-13, 1e-11, 1e-9, 1e-6, 1e-3}) {
      ratio_ *= 1 + more;
      const auto holds = [&](const Disc& top) {
        return std::ranges::all_of(lowest, [&](const Disc& low) { return excludes(top, low); });
      };
      if (std::isfinite(ratio_) && std::ranges::all_of(values_->highest(), holds)) return true;
    }
    return false;
  }

  [[nodiscard]] bool is_positive(const Disc& low) const {
    RoundSum sum;
    const std::size_t l = low.index;
    sum.add(-low.alpha * d(l));
    sum.add(low.alpha * entries_.error[l]);
    sum.add(low.beta);
    for (std::size_t k = 0; k < p_; ++k) sum.add(low.alpha * std::fabs(g(k, l)) * box_.radius[k]);
    return sum.is_certainly_negative();
  }

  [[nodiscard]] bool excludes(const Disc& top, const Disc& low) const {
    RoundSum sum;
    const std::size_t i = top.index, l = low.index;
    sum.add(top.alpha * d(i));
    sum.add(top.alpha * entries_.error[i]);
    sum.add(top.beta);
    sum.add(-ratio_ * low.alpha * d(l));
    sum.add(ratio_ * low.alpha * entries_.error[l]);
    sum.add(ratio_ * low.beta);
    for (std::size_t k = 0; k < p_; ++k) {
      const double a = top.alpha * g(k, i), b = ratio_ * low.alpha * g(k, l), r = box_.radius[k];
      sum.add(std::fabs(a - b) * r, (std::fabs(a) + std::fabs(b)) * r);
    }
    return sum.is_certainly_negative();
  }

  /// Returns roughly what variable k adds to the excess by errors of second order.
  [[nodiscard]] double impact_of(std::size_t k) const {
    const auto [above, below] = values_->shares(entries_.parts[k]);
    const auto error = [&](std::size_t i) { return entries_.parts[k][i * n_ + i]; };
    return above + error(top_.index) + (below + error(low_.index)) * d(0) / d(n_ - 1);
  }

  const RotatedBox& box_;
  const std::size_t m_, n_, p_;
  const EntryBounds entries_;
  std::optional<ExtremeValues> values_;
  Disc top_{}, low_{};  ///< those that raised T last
  double ratio_ = 1;    ///< T
};

}  // namespace

ConditionBound bound_condition(const RotatedBox& box) { return BoxCondition(box).run(); }

}  // namespace regulus::detail
