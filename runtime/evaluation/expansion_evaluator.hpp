// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "runtime/evaluation/product_evaluator.hpp"
#include "runtime/regularity/second_order.hpp"

namespace regulus::detail {

/// Bounds K·A by its expansion to second order (runtime/regularity/second_order.hpp).
class ExpansionEvaluator {
 public:
  /// All must outlive this object.
  ///
  /// Requires  the kernel has an expansion; structure.is_known(). for_easy_boxes: motion_bounds()
  ///           will be called.
  ExpansionEvaluator(const BoxLanes& lanes, MidpointEvaluator& midpoint, ProductEvaluator& product,
                     const RowStructure& structure, const EvaluationPlan& plan,
                     bool for_easy_boxes);

  void forget() noexcept {
    called_.forget();
    computed_.forget();
    computed_along_motion_.forget();
  }
  /// Forgets what is known of the variables that did not change from box to box.
  void forget_root() noexcept {
    point_known_ = false;
    orthant_hint_ = {};
  }

  [[nodiscard]] std::size_t order() const noexcept { return second_order_.order(); }
  /// Returns T, of order order(); +∞ in lanes without T.
  [[nodiscard]] ConstPointMatrix bounds() noexcept;
  /// Returns another T, for a K that moves with the motion parameters only. It takes half the time,
  /// and is hardly wider if the other variables' ranges are tiny.
  [[nodiscard]] ConstPointMatrix motion_bounds() noexcept;
  /// Returns the lanes that have T.
  [[nodiscard]] LaneMask defined() noexcept;
  /// Returns upper bounds of |det K(t)|/|det K| for the preconditioner that belongs to T.
  [[nodiscard]] LaneNumbers moving_determinant_ru() noexcept;
  /// Calls SecondOrderBounds::certain_by_orthants on T; guess: its right Perron vector.
  [[nodiscard]] LaneMask certain_by_orthants(ConstPointVector guess, LaneMask lanes,
                                             unsigned halvings) noexcept;
  /// Computes what each variable adds to the spectral radius of T, roughly. In lanes without T: how
  /// far it moves K·A to first order.
  void approx_impact(PerronVectors vectors, PointVector impact) noexcept;

 private:
  void call_kernel() noexcept;
  void compute(SecondOrderBounds& second_order, PointMatrix T) noexcept;
  void load_expansion_point() noexcept;
  void add_impact_at_center(LaneMask lanes, PointVector impact) const noexcept;
  [[nodiscard]] SecondOrderInput input() noexcept;
  [[nodiscard]] LaneMask call_listed(const regulus_derivatives& derivatives,
                                     ConstIntervalVector boxes, AlignedBuffer& out) noexcept;

  const BoxLanes& lanes_;
  MidpointEvaluator& midpoint_;
  ProductEvaluator& product_;
  const regulus_kernel& kernel_;
  const regulus_expansion& expansion_;
  const RowStructure& structure_;
  SecondOrderBounds second_order_;
  std::optional<SecondOrderBounds> along_motion_;
  AlignedBuffer point_, radius_, center_product_;
  AlignedBuffer first_, second_, row_first_, row_second_, bounds_, motion_bounds_;
  Once called_, computed_, computed_along_motion_;
  bool point_known_ = false;
  LaneMask point_outside_contract_ = 0, defined_ = 0;
  OrthantCell orthant_hint_{};
};

}  // namespace regulus::detail
