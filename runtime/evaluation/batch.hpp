// SPDX-License-Identifier: Apache-2.0
// Up to eight boxes and everything that is known about them: the boxes themselves (BoxLanes), and
// for each kind of quantity an evaluator that owns its numbers. A quantity is computed for all
// lanes at its first use, so that a test pays only for quantities that it needs. After construction
// nothing is allocated.
#pragma once

#include <optional>
#include <span>

#include "runtime/evaluation/impact_evaluator.hpp"
#include "runtime/evaluation/pose_evaluator.hpp"
#include "runtime/regularity/row_structure.hpp"

namespace regulus::detail {

class Batch {
 public:
  /// `problem` must be free of faults; its kernels and `structure` must outlive this object.
  Batch(const Problem& problem, const Settings& settings, const RowStructure& structure,
        bool for_easy_boxes = false);
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  /// Forgets everything, and takes the problem's faster kernel if there is one by now. Then load
  /// 1…8 lanes from 0, without gaps, and seal.
  void clear() noexcept;
  void load(std::size_t lane, std::span<const Interval> box) noexcept { lanes_.load(lane, box); }
  /// Loads copies of lane 0 into the lanes before `count`; single ranges may then be changed.
  void spread(std::size_t count) noexcept { lanes_.spread(count); }
  void change(std::size_t lane, std::size_t variable, Interval x) noexcept {
    lanes_.change(lane, variable, x);
  }
  /// Fills the lanes from `count` on with copies of lane 0: kernels need eight proper boxes.
  void seal(std::size_t count) noexcept { lanes_.seal(count); }

  [[nodiscard]] LaneMask loaded() const noexcept { return lanes_.loaded(); }
  [[nodiscard]] Interval box(std::size_t variable, std::size_t lane) const noexcept {
    return lanes_.box(variable, lane);
  }
  [[nodiscard]] ConstIntervalVector boxes() const noexcept { return lanes_.boxes(); }
  [[nodiscard]] double midpoint(std::size_t variable, std::size_t lane) const noexcept {
    return lanes_.midpoints().at(variable, lane);
  }

  // PoseEvaluator.

  [[nodiscard]] LaneMask certain_outside() noexcept { return pose_.certain_outside(); }
  [[nodiscard]] LaneMask certain_inside() noexcept { return pose_.certain_inside(); }
  [[nodiscard]] LaneMask certain_posed() noexcept { return pose_.certain_posed(); }
  [[nodiscard]] ConstIntervalVector row_scales() noexcept { return pose_.row_scales(); }
  [[nodiscard]] Interval row_scale(std::size_t lane) noexcept {
    return {row_scales().lower(0, lane), row_scales().upper(0, lane)};
  }
  [[nodiscard]] LaneMask midpoint_inside() noexcept { return pose_.midpoint_inside(); }
  [[nodiscard]] LaneMask midpoint_outside() noexcept { return pose_.midpoint_outside(); }
  [[nodiscard]] double approx_row_scale(std::size_t lane) noexcept {
    return pose_.approx_row_scale(lane);
  }

  // MidpointEvaluator.

  [[nodiscard]] LaneMask midpoint_defined() noexcept { return midpoint_.defined(); }
  [[nodiscard]] LaneMask preconditioned() noexcept { return midpoint_.preconditioned(); }
  [[nodiscard]] ConstPointMatrix preconditioner() noexcept { return midpoint_.preconditioner(); }
  [[nodiscard]] LaneMask poorly_preconditioned() noexcept {
    return midpoint_.poorly_preconditioned();
  }
  [[nodiscard]] Interval preconditioner_determinant(std::size_t lane) noexcept {
    return midpoint_.preconditioner_determinant(lane);
  }
  [[nodiscard]] double approx_determinant(std::size_t lane) noexcept {
    return midpoint_.approx_determinant(lane);
  }

  // ProductEvaluator, FirstOrderBounds, ExpansionEvaluator, ClosedFormEvaluator, ImpactEvaluator.

  [[nodiscard]] ConstIntervalMatrix product(ProductForm form, LaneMask& lanes) noexcept {
    return product_.product(form, lanes);
  }
  [[nodiscard]] ConstPointMatrix natural_bounds() noexcept { return first_order_.natural(); }
  [[nodiscard]] ConstPointMatrix mean_value_bounds() noexcept { return first_order_.mean_value(); }
  /// Requires  the structure is known. The same holds for the next three.
  [[nodiscard]] ConstPointMatrix second_order_bounds() noexcept { return expansion_->bounds(); }
  /// Requires  the structure is known; for_easy_boxes.
  [[nodiscard]] ConstPointMatrix motion_bounds() noexcept { return expansion_->motion_bounds(); }
  /// Returns the lanes in which they are defined.
  [[nodiscard]] LaneMask expanded() noexcept { return expansion_->defined(); }
  [[nodiscard]] LaneNumbers moving_determinant_ru() noexcept {
    return expansion_->moving_determinant_ru();
  }
  [[nodiscard]] LaneMask certain_by_orthants(LaneMask lanes, unsigned halvings) noexcept;
  [[nodiscard]] ConstIntervalVector natural_determinant() noexcept {
    return closed_form_.natural();
  }
  [[nodiscard]] ConstIntervalVector monotone_determinant() noexcept {
    return closed_form_.monotone();
  }
  [[nodiscard]] double approx_spectral_radius(std::size_t lane) noexcept {
    return impact_.approx_spectral_radius(lane);
  }
  [[nodiscard]] ConstPointVector approx_impact() noexcept { return impact_.approx_impact(); }

  // Several evaluators together.

  /// Encloses det A (`scaled`: det J⁻¹) over a box of a square kernel; nullopt if it is not
  /// certainly defined there.
  [[nodiscard]] std::optional<Interval> determinant(std::size_t lane, bool scaled) noexcept;
  /// Returns true only if |det A| ≥ lower implies |det J⁻¹| > α.
  [[nodiscard]] bool certain_above_threshold(std::size_t lane, double lower) noexcept;

  // Vectors that prove regularity.

  /// Returns the order of T; for P, only the first `columns` entries are used.
  [[nodiscard]] std::size_t order() const noexcept { return order_; }
  /// Returns the vector in which a test computes its v of `entries` ≤ order(). keep_vector then
  /// saves the vectors that proved something.
  [[nodiscard]] PointVector candidate_vector(std::size_t entries) noexcept {
    return PointVector(candidate_vector_.get(), entries);
  }
  void keep_vector(LaneMask lanes, std::size_t entries) noexcept;
  /// Returns v of the test that certified a lane.
  [[nodiscard]] ConstPointVector vector() const noexcept {
    return ConstPointVector(vector_.get(), order_);
  }

  /// Declares that the box of this batch contains all boxes to come, and has the same ranges in the
  /// variables that may not be split. So properties that hold on all of it are not checked again,
  /// and those variables are not loaded again.
  ///
  /// Requires  that box is in every lane.
  void learn_from_root() noexcept;
  /// Forgets it, for the boxes of another root. The lanes are empty then.
  void forget_root() noexcept;

  /// Calls a function of the kernel on the boxes.
  [[nodiscard]] LaneMask call_on_boxes(regulus_function function, double* out) noexcept {
    return lanes_.call(function, lanes_.boxes(), nullptr, out);
  }
  [[nodiscard]] const regulus_kernel& kernel() const noexcept { return lanes_.kernel(); }

 private:
  const Interval alpha_;
  const EvaluationPlan plan_;
  const std::size_t order_;
  BoxLanes lanes_;
  PoseEvaluator pose_;
  MidpointEvaluator midpoint_;
  MatrixEvaluator matrix_;
  DerivativeEvaluator derivatives_;
  ProductEvaluator product_;
  FirstOrderBounds first_order_;
  std::optional<ExpansionEvaluator> expansion_;  ///< if the structure is known
  ClosedFormEvaluator closed_form_;
  ImpactEvaluator impact_;
  AlignedBuffer vector_, candidate_vector_;
};

}  // namespace regulus::detail
