// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/singular_value_test.hpp"

#include <algorithm>
#include <cmath>

#include "codegen/question/condition/entry_bounds.hpp"
#include "codegen/question/condition/extreme_values.hpp"

namespace regulus::detail {
namespace {

using Doubles = std::vector<double>;

class BoxValue {
 public:
  BoxValue(const RotatedBox& box, Extreme extreme)
      : box_(box), is_largest_(extreme == Extreme::kLargest), n_(box.columns), entries_(box) {}

  SingularValueBound run() {
    const Reach reach = extreme_diagonal();
    const ExtremeValues values(entries_.off, box_.rows, n_, reach, reach);
    SingularValueBound result{is_largest_ ? kInfinity : 0.0};
    const Disc decisive = is_largest_ ? find_largest(values, result) : find_least(values, result);
    const std::size_t i = decisive.index;
    for (std::size_t k = 0; k < box_.radius.size(); ++k) {
      const auto [above, below] = values.shares(entries_.parts[k]);
      result.impact.push_back((is_largest_ ? above : below) + entries_.parts[k][i * n_ + i]);
      result.growth.push_back(slope(k, i) / middle(i));
    }
    return result;
  }

 private:
  [[nodiscard]] double middle(std::size_t i) const { return box_.center.middle[i * n_ + i]; }
  [[nodiscard]] double slope(std::size_t k, std::size_t i) const {
    return box_.slopes[k].middle[i * n_ + i];
  }
  /// How far b_i is from d_i.
  [[nodiscard]] double change(std::size_t i) const {
    double sum = entries_.error[i];
    for (std::size_t k = 0; k < box_.radius.size(); ++k)
      sum += std::fabs(slope(k, i)) * box_.radius[k];
    return enlarged(sum);
  }

  [[nodiscard]] Reach extreme_diagonal() const {
    Reach reach;
    for (std::size_t i = 0; i < n_; ++i)
      reach.goal.push_back(is_largest_ ? std::fabs(middle(i)) + change(i) : middle(i) - change(i));
    reach.farthest = reach.goal;
    return reach;
  }

  [[nodiscard]] Disc find_largest(const ExtremeValues& values, SingularValueBound& result) const {
    double most = -1;
    Disc decisive = values.highest().front();
    for (const Disc& disc : values.highest()) {
      const double top = std::fabs(middle(disc.index)) + change(disc.index);
      const double value = enlarged(disc.alpha * top + disc.beta);
      if (!(value < kInfinity)) return decisive;
      if (value > most) most = value, decisive = disc;
    }
    result.value = mul_ru(most, box_.distortion.largest);
    return decisive;
  }

  /// The sum of the magnitudes bounds what the roundings add, by enlarged().
  [[nodiscard]] Disc find_least(const ExtremeValues& values, SingularValueBound& result) const {
    double least = kInfinity;
    Disc decisive = values.lowest()[n_ - 1];
    for (const Disc& disc : values.lowest()) {
      const double d = middle(disc.index), away = change(disc.index);
      const double size = disc.alpha * (std::fabs(d) + away) + disc.beta;
      const double value = disc.alpha * (d - away) - disc.beta - 2 * (enlarged(size) - size);
      if (std::isnan(value)) return decisive;
      if (value < least) least = value, decisive = disc;
    }
    if (least > 0 && box_.distortion.least < kInfinity)
      result.value = div_rd(least, box_.distortion.least);
    return decisive;
  }

  const RotatedBox& box_;
  const bool is_largest_;
  const std::size_t n_;
  const EntryBounds entries_;
};

}  // namespace

SingularValueBound bound_singular_value(const RotatedBox& box, Extreme extreme) {
  return BoxValue(box, extreme).run();
}

}  // namespace regulus::detail
