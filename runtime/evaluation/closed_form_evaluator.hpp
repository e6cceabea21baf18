// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/evaluation/box_lanes.hpp"
#include "runtime/evaluation/evaluation_plan.hpp"

namespace regulus::detail {

/// Encloses the determinant in closed form: one entry, [−∞, ∞] in lanes without an enclosure.
class ClosedFormEvaluator {
 public:
  ClosedFormEvaluator(const BoxLanes& lanes, const EvaluationPlan& plan);

  void forget() noexcept;

  /// Uses the kernel's `determinant` over the boxes.
  [[nodiscard]] ConstIntervalVector natural() noexcept;
  /// The same, made narrower by the signs and the magnitudes of the derivatives.
  ///
  /// Requires  the kernel has the derivatives, and the plan sees the determinant.
  [[nodiscard]] ConstIntervalVector monotone() noexcept;
  /// Computes what each variable that may be split adds to the width, roughly; 0 if unknown.
  void approx_impact(PointVector impact) noexcept;

 private:
  void compute_derivatives() noexcept;
  void load_face(bool least) noexcept;
  void narrow_on_face(bool least) noexcept;

  const BoxLanes& lanes_;
  const regulus_kernel& kernel_;
  const std::size_t variables_, splittable_;
  AlignedBuffer determinant_, monotone_, slopes_, face_, face_center_, on_face_, on_center_;
  Once natural_known_, monotone_known_, slopes_known_;
  LaneMask slopes_defined_ = 0;
};

}  // namespace regulus::detail
