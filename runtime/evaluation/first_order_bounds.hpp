// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/evaluation/product_evaluator.hpp"

namespace regulus::detail {

/// Bounds |KA − I| over the boxes by a matrix P.
class FirstOrderBounds {
 public:
  /// All must outlive this object.
  FirstOrderBounds(const BoxLanes& lanes, MidpointEvaluator& midpoint, ProductEvaluator& product,
                   DerivativeEvaluator& derivatives, const EvaluationPlan& plan);

  void forget() noexcept;

  /// Returns P from natural entries; +∞ in lanes without P.
  [[nodiscard]] ConstPointMatrix natural() noexcept;
  /// Returns the same P, lowered to the mean-value bound if that is smaller.
  [[nodiscard]] ConstPointMatrix mean_value() noexcept;

 private:
  [[nodiscard]] PointMatrix P() noexcept;

  const BoxLanes& lanes_;
  MidpointEvaluator& midpoint_;
  ProductEvaluator& product_;
  DerivativeEvaluator& derivatives_;
  const bool sees_mean_values_;
  const std::size_t columns_;
  AlignedBuffer bounds_, center_, product_at_center_;
  Once natural_, mean_value_;
};

}  // namespace regulus::detail
