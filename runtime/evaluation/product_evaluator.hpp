// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "runtime/evaluation/entry_sharpener.hpp"

namespace regulus::detail {

/// Encloses A and its products with K over the boxes.
class ProductEvaluator {
 public:
  /// All must outlive this object.
  ProductEvaluator(const BoxLanes& lanes, MidpointEvaluator& midpoint,
                   DerivativeEvaluator& derivatives, MatrixEvaluator& matrix,
                   const EvaluationPlan& plan);

  void forget() noexcept;

  /// Returns K·A, A·K or A; removes lanes that are not defined from `lanes`. The matrix of the
  /// method is sharpened in the lanes of the first call, if the plan says so.
  [[nodiscard]] ConstIntervalMatrix product(ProductForm form, LaneMask& lanes) noexcept;

 private:
  struct Enclosure {
    AlignedBuffer entries;
    Once computed;
    LaneMask defined = 0;
  };
  [[nodiscard]] IntervalMatrix compute(ProductForm form, LaneMask& lanes) noexcept;
  [[nodiscard]] Enclosure& enclosure_of(ProductForm form) noexcept;
  [[nodiscard]] IntervalMatrix view(Enclosure& enclosure, ProductForm form) const noexcept;

  const BoxLanes& lanes_;
  MidpointEvaluator& midpoint_;
  MatrixEvaluator& matrix_;
  const regulus_kernel& kernel_;
  std::unique_ptr<EntrySharpener> sharpener_;  ///< if the plan has one
  Once sharpened_;
  Enclosure plain_, left_, right_, left_numeric_, right_numeric_;
};

}  // namespace regulus::detail
