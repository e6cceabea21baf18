// SPDX-License-Identifier: Apache-2.0
#include "runtime/evaluation/pose_evaluator.hpp"

#include <algorithm>
#include <cstring>

namespace regulus::detail {

PoseEvaluator::PoseEvaluator(const BoxLanes& lanes)
    : lanes_(lanes),
      kernel_(lanes.kernel()),
      outputs_(2 * kLanes * std::max({kernel_.constraints, kernel_.pose_parameters, 1U})) {}

void PoseEvaluator::forget() noexcept {
  for (Once* once : {&constrained_, &midpoint_constrained_, &posed_known_, &midpoint_scaled_})
    once->forget();
}

PoseEvaluator::Sides PoseEvaluator::sides_of(ConstIntervalVector boxes) noexcept {
  if (kernel_.constraints == 0) return {kAllLanes, 0};
  Sides sides{kAllLanes, 0};
  // A lane with an undefined constraint is neither inside nor outside.
  const LaneMask defined = lanes_.call(kernel_.constraint, boxes, nullptr, outputs_.get());
  for (std::size_t h = 0; h < kernel_.constraints; ++h)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (!(outputs_[upper_at(h, lane)] <= 0.0)) sides.inside &= ~(1U << lane);
      if (outputs_[lower_at(h, lane)] > 0.0) sides.outside |= 1U << lane;
    }
  return {sides.inside & defined, sides.outside & defined};
}

const PoseEvaluator::Sides& PoseEvaluator::sides() noexcept {
  if (constrained_.begin()) sides_ = sides_of(lanes_.boxes());
  return sides_;
}

const PoseEvaluator::Sides& PoseEvaluator::midpoint_sides() noexcept {
  if (midpoint_constrained_.begin()) midpoint_sides_ = sides_of(lanes_.thin());
  return midpoint_sides_;
}

LaneMask PoseEvaluator::certain_outside() noexcept { return sides().outside & lanes_.loaded(); }
LaneMask PoseEvaluator::certain_inside() noexcept { return sides().inside & lanes_.loaded(); }
LaneMask PoseEvaluator::midpoint_inside() noexcept {
  return midpoint_sides().inside & lanes_.loaded();
}
LaneMask PoseEvaluator::midpoint_outside() noexcept {
  return midpoint_sides().outside & lanes_.loaded();
}

void PoseEvaluator::compute_posed() noexcept {
  posed_ = kAllLanes;
  std::fill_n(scale_, 2 * kLanes, 1.0);
  if (kernel_.row_scale != nullptr) {
    posed_ &= lanes_.call(kernel_.row_scale, lanes_.boxes(), nullptr, outputs_.get());
    std::memcpy(scale_, outputs_.get(), sizeof scale_);
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      if (!(scale_[lower_at(0, lane)] > 0.0)) posed_ &= ~(1U << lane);
  }
  if (kernel_.pose != nullptr)
    posed_ &= lanes_.call(kernel_.pose, lanes_.boxes(), nullptr, outputs_.get());
}

LaneMask PoseEvaluator::certain_posed() noexcept {
  if (posed_everywhere_) return lanes_.loaded();
  if (posed_known_.begin()) compute_posed();
  return posed_ & lanes_.loaded();
}

ConstIntervalVector PoseEvaluator::row_scales() noexcept {
  if (posed_known_.begin()) compute_posed();
  return ConstIntervalVector(scale_, 1);
}

void PoseEvaluator::approx_scales() noexcept {
  std::fill_n(approx_scale_, kLanes, 1.0);
  if (kernel_.row_scale == nullptr) return;
  const LaneMask defined = lanes_.call(kernel_.row_scale, lanes_.thin(), nullptr, outputs_.get());
  for_each_lane(defined, [this](std::size_t lane) {
    approx_scale_[lane] = 0.5 * outputs_[lower_at(0, lane)] + 0.5 * outputs_[upper_at(0, lane)];
  });
}

double PoseEvaluator::approx_row_scale(std::size_t lane) noexcept {
  if (midpoint_scaled_.begin()) approx_scales();
  return approx_scale_[lane];
}

}  // namespace regulus::detail
