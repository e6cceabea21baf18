// SPDX-License-Identifier: Apache-2.0
// Up to eight boxes side by side, and calls of a kernel's functions on them. The evaluators of a
// Batch read this data.
#pragma once

#include <atomic>
#include <span>
#include <utility>

#include "runtime/interval/interval.hpp"
#include "runtime/kernel/call.hpp"
#include "runtime/problem/problem.hpp"
#include "runtime/regularity/aligned_buffer.hpp"
#include "runtime/regularity/views.hpp"

namespace regulus::detail {

/// A computation that is done once for each batch, when its result is first needed.
class Once {
 public:
  /// Returns true if it must be done now; from then on it counts as done.
  [[nodiscard]] bool begin() noexcept { return !std::exchange(made_, true); }
  void forget() noexcept { made_ = false; }

 private:
  bool made_ = false;
};

class BoxLanes {
 public:
  /// The kernels of the problem, and all that they point to, must outlive this object.
  explicit BoxLanes(const Problem& problem);
  BoxLanes(const BoxLanes&) = delete;
  BoxLanes& operator=(const BoxLanes&) = delete;

  /// Takes the problem's faster kernel if there is one by now. Then load 1…8 lanes from 0, without
  /// gaps, and seal.
  void clear() noexcept;
  void load(std::size_t lane, std::span<const Interval> box) noexcept;
  /// Loads copies of lane 0 into the lanes before `count`; single ranges may then be changed.
  void spread(std::size_t count) noexcept;
  void change(std::size_t lane, std::size_t variable, Interval x) noexcept;
  /// Fills the lanes from `count` on with copies of lane 0: kernels need eight proper boxes.
  void seal(std::size_t count) noexcept;
  /// In all boxes to come, the variables from `first` on have the same ranges as now.
  ///
  /// Requires  the present box is in every lane.
  void fix_from(std::size_t first) noexcept;
  /// Every variable is loaded again.
  void fix_none() noexcept { changing_ = variables_; }

  [[nodiscard]] LaneMask loaded() const noexcept { return loaded_; }
  [[nodiscard]] const regulus_kernel& kernel() const noexcept { return kernel_; }
  [[nodiscard]] std::size_t variables() const noexcept { return variables_; }
  /// The variables 0 … changing() − 1 differ from batch to batch.
  [[nodiscard]] std::size_t changing() const noexcept { return changing_; }

  [[nodiscard]] Interval box(std::size_t variable, std::size_t lane) const noexcept {
    return {boxes_[lower_at(variable, lane)], boxes_[upper_at(variable, lane)]};
  }
  [[nodiscard]] ConstIntervalVector boxes() const noexcept {
    return ConstIntervalVector(boxes_.get(), variables_);
  }
  /// Returns the midpoints as thin boxes.
  [[nodiscard]] ConstIntervalVector thin() const noexcept {
    return ConstIntervalVector(thin_.get(), variables_);
  }
  [[nodiscard]] ConstPointVector midpoints() const noexcept {
    return ConstPointVector(midpoint_.get(), variables_);
  }
  /// Returns upper bounds of the distances from the midpoints.
  [[nodiscard]] ConstPointVector radii() const noexcept {
    return ConstPointVector(radius_.get(), variables_);
  }

  /// Calls a function of the kernel on `boxes`, which lie within the loaded boxes, with the entries
  /// K; null: the function needs no K.
  ///
  /// Ensures   returns the lanes whose outputs are enclosures; none if `function` is null.
  LaneMask call(regulus_function function, ConstIntervalVector boxes, const double* K,
                double* out) const noexcept;

 private:
  [[nodiscard]] regulus_kernel copied(const regulus_kernel& kernel) noexcept;
  void copy_first_lane(std::size_t from) noexcept;

  // Copies, so that a kernel is exchanged as a whole: its functions need its own context.
  regulus_expansion expansion_{};
  regulus_kernel kernel_;
  const CheckedKernel caller_;  ///< calls kernel_
  const std::atomic<const regulus_kernel*>* const faster_kernel_;
  const std::size_t variables_;
  std::size_t changing_;
  LaneMask loaded_ = 0, outside_contract_ = 0, fixed_outside_contract_ = 0;
  AlignedBuffer boxes_, thin_, midpoint_, radius_;
};

}  // namespace regulus::detail
