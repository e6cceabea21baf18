// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/evaluation/box_lanes.hpp"

namespace regulus::detail {

/// Finds which boxes and midpoints satisfy the constraints, where the pose is defined, and how the
/// rows are scaled there.
class PoseEvaluator {
 public:
  explicit PoseEvaluator(const BoxLanes& lanes);

  void forget() noexcept;

  // Over the boxes. A lane is in a mask if the statement holds at all points of its box.

  /// Some constraint is certainly positive.
  [[nodiscard]] LaneMask certain_outside() noexcept;
  /// Every constraint is certainly ≤ 0.
  [[nodiscard]] LaneMask certain_inside() noexcept;
  /// The row scales are defined and positive, and the pose is defined.
  [[nodiscard]] LaneMask certain_posed() noexcept;
  /// Encloses the product of the row scales: one entry.
  [[nodiscard]] ConstIntervalVector row_scales() noexcept;

  // At the midpoints.

  [[nodiscard]] LaneMask midpoint_inside() noexcept;
  [[nodiscard]] LaneMask midpoint_outside() noexcept;
  [[nodiscard]] double approx_row_scale(std::size_t lane) noexcept;

  /// Declares that what holds for the box of lane 0 holds for all boxes to come.
  void learn_from_root() noexcept { posed_everywhere_ = has_lane(certain_posed(), 0); }
  /// Forgets what it learned.
  void forget_root() noexcept { posed_everywhere_ = false; }

 private:
  struct Sides {
    LaneMask inside = 0, outside = 0;
  };
  [[nodiscard]] Sides sides_of(ConstIntervalVector boxes) noexcept;
  [[nodiscard]] const Sides& sides() noexcept;
  [[nodiscard]] const Sides& midpoint_sides() noexcept;
  void compute_posed() noexcept;
  void approx_scales() noexcept;

  const BoxLanes& lanes_;
  const regulus_kernel& kernel_;
  AlignedBuffer outputs_;
  Once constrained_, midpoint_constrained_, posed_known_, midpoint_scaled_;
  Sides sides_, midpoint_sides_;
  LaneMask posed_ = 0;
  bool posed_everywhere_ = false;
  alignas(64) double scale_[2 * kLanes] = {};
  double approx_scale_[kLanes] = {};
};

}  // namespace regulus::detail
