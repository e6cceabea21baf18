// SPDX-License-Identifier: Apache-2.0
#include "runtime/evaluation/box_lanes.hpp"

#include <algorithm>

namespace regulus::detail {

BoxLanes::BoxLanes(const Problem& problem)
    : kernel_(copied(*problem.kernel)),
      caller_(kernel_),
      faster_kernel_(problem.faster_kernel),
      variables_(kernel_.variables),
      changing_(variables_),
      boxes_(2 * variables_ * kLanes),
      thin_(2 * variables_ * kLanes),
      midpoint_(variables_ * kLanes),
      radius_(variables_ * kLanes) {}

/// Returns the table, with this object's own copy of the expansion.
regulus_kernel BoxLanes::copied(const regulus_kernel& kernel) noexcept {
  regulus_kernel copy = kernel;
  if (kernel.expansion == nullptr) return copy;
  expansion_ = *kernel.expansion;
  copy.expansion = &expansion_;
  return copy;
}

void BoxLanes::clear() noexcept {
  loaded_ = 0;
  if (faster_kernel_ == nullptr) return;
  if (const regulus_kernel* kernel = faster_kernel_->load(std::memory_order_acquire))
    kernel_ = copied(*kernel);
}

void BoxLanes::load(std::size_t lane, std::span<const Interval> box) noexcept {
  for (std::size_t k = 0; k < changing_; ++k) change(lane, k, box[k]);
  loaded_ |= 1U << lane;
}

void BoxLanes::change(std::size_t lane, std::size_t k, Interval x) noexcept {
  const bool thin = x.lo == x.hi;
  const double middle = thin ? x.lo : mid(x);
  const double radius = thin ? 0.0 : rad_ru(x);
  boxes_[lower_at(k, lane)] = x.lo;
  boxes_[upper_at(k, lane)] = x.hi;
  midpoint_[point_at(k, lane)] = middle;
  thin_[lower_at(k, lane)] = thin_[upper_at(k, lane)] = middle;
  radius_[point_at(k, lane)] = radius;
}

/// Copies the first lane to the lanes from `from` on.
void BoxLanes::copy_first_lane(std::size_t from) noexcept {
  const auto copy = [from](double* row) { std::fill(row + from, row + kLanes, row[0]); };
  for (std::size_t k = 0; k < changing_; ++k) {
    for (double* bounds : {boxes_.get(), thin_.get()})
      copy(bounds + lower_at(k, 0)), copy(bounds + upper_at(k, 0));
    copy(midpoint_.get() + point_at(k, 0));
    copy(radius_.get() + point_at(k, 0));
  }
}

void BoxLanes::spread(std::size_t count) noexcept {
  copy_first_lane(1);
  loaded_ = kAllLanes >> (kLanes - count);
}

void BoxLanes::seal(std::size_t count) noexcept {
  copy_first_lane(count);
  // A midpoint, or any other part of a box within the contract, is also within the contract.
  const LaneMask changed = lanes_outside_contract(boxes_.get(), static_cast<unsigned>(changing_));
  outside_contract_ = changing_ < variables_ ? fixed_outside_contract_ | changed : changed;
}

void BoxLanes::fix_from(std::size_t first) noexcept {
  changing_ = first;
  fixed_outside_contract_ = outside_contract_;
}

LaneMask BoxLanes::call(regulus_function function, ConstIntervalVector boxes, const double* K,
                        double* out) const noexcept {
  if (function == nullptr) return 0;
  const LaneMask undefined = caller_.call_within_contract(function, boxes.data(), K, out);
  if (outside_contract_ != 0) caller_.forget(function, outside_contract_, out);
  return kAllLanes & ~outside_contract_ & ~undefined;
}

}  // namespace regulus::detail
