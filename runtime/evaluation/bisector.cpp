// SPDX-License-Identifier: Apache-2.0
#include "runtime/evaluation/bisector.hpp"

#include <algorithm>

namespace regulus::detail {

Bisector::Bisector(const Problem& problem, const Settings& settings)
    : bisection_(settings.bisection),
      weights_(settings.weights),
      splittable_(settings.uncertainty == Uncertainty::kVariables
                      ? problem.kernel->variables
                      : problem.kernel->motion_variables) {
  for (std::size_t k = 0; k < problem.outer.size(); ++k) {
    const bool idle = !problem.idle.empty() && problem.idle[k] != 0;
    const double range = problem.outer[k].hi - problem.outer[k].lo;
    range_.push_back(idle ? 0.0 : range);
    least_width_.push_back(idle ? kInfinity : range * settings.min_relative_width);
  }
}

bool Bisector::can_split(Interval x, std::size_t variable) const noexcept {
  return x.hi - x.lo > least_width_[variable] && bisect(x).has_value();
}

bool Bisector::splits(std::span<const Interval> box) const noexcept {
  for (std::size_t k = 0; k < splittable_; ++k)
    if (can_split(box[k], k)) return true;
  return false;
}

double Bisector::approx_score(Batch& batch, std::size_t variable, std::size_t lane) const noexcept {
  const Interval x = batch.box(variable, lane);
  switch (bisection_) {
    case Bisection::kWidest:
      return x.hi - x.lo;
    case Bisection::kWeighted:
      return (x.hi - x.lo) / range_[variable] * (weights_.empty() ? 1.0 : weights_[variable]);
    case Bisection::kImpact:
      return batch.approx_impact().at(variable, lane);
  }
  return 0.0;
}

std::optional<std::size_t> Bisector::choose(Batch& batch, std::size_t lane) const noexcept {
  std::optional<std::size_t> best, widest;
  double best_score = 0.0;
  double best_width = 0.0;
  for (std::size_t k = 0; k < splittable_; ++k) {
    const Interval x = batch.box(k, lane);
    if (!can_split(x, k)) continue;
    const double width = (x.hi - x.lo) / range_[k];
    if (!widest || width > best_width) widest = k, best_width = width;
    const double score = approx_score(batch, k, lane);
    if (score > best_score) best = k, best_score = score;
  }
  // No variable has a score, or the scores are NaN: the relatively widest one makes progress.
  return best ? best : widest;
}

std::size_t Bisector::variables_to_split() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(range_.begin(), range_.begin() + static_cast<std::ptrdiff_t>(splittable_),
                    [](double width) { return width > 0.0; }));
}

double Bisector::approx_relative_width(std::span<const Interval> box) const noexcept {
  double width = 0.0;
  for (std::size_t k = 0; k < splittable_; ++k)
    if (range_[k] > 0.0) width = std::max(width, (box[k].hi - box[k].lo) / range_[k]);
  return width;
}

}  // namespace regulus::detail
