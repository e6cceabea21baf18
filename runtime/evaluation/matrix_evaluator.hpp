// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/evaluation/evaluation_plan.hpp"
#include "runtime/evaluation/midpoint_evaluator.hpp"

namespace regulus::detail {

/// Returns the kernel's function for a product with K; null for A, for numeric products, and if the
/// kernel has none.
[[nodiscard]] regulus_function symbolic_product(const regulus_kernel& kernel,
                                                ProductForm form) noexcept;

/// Computes K·A, A·K of eight matrices A.
///
/// Shape     A m×n, K n×m, product n×n, m×m.
/// Rounding  outward.
void multiply_left(ConstIntervalMatrix A, ConstPointMatrix K, IntervalMatrix product) noexcept;
void multiply_right(ConstIntervalMatrix A, ConstPointMatrix K, IntervalMatrix product) noexcept;

/// Evaluates the matrix that the method uses on any eight boxes and with any K.
class MatrixEvaluator {
 public:
  MatrixEvaluator(const BoxLanes& lanes, ProductForm form);

  /// Returns the lanes in which `matrix` is an enclosure. The boxes lie within the loaded boxes,
  /// and K is within the contract of kernels.
  LaneMask evaluate(ConstIntervalVector boxes, ConstPointMatrix K, IntervalMatrix matrix) noexcept;

  [[nodiscard]] ProductForm form() const noexcept { return form_; }
  /// The rows and columns of a product; if there is no product, those of A.
  [[nodiscard]] std::size_t rows(ProductForm form) const noexcept;
  [[nodiscard]] std::size_t columns(ProductForm form) const noexcept;

 private:
  const BoxLanes& lanes_;
  const regulus_kernel& kernel_;
  const ProductForm form_;
  AlignedBuffer factor_;
};

/// Encloses the derivatives of that matrix over the boxes.
class DerivativeEvaluator {
 public:
  /// All must outlive this object.
  DerivativeEvaluator(const BoxLanes& lanes, MidpointEvaluator& midpoint,
                      const EvaluationPlan& plan);

  void forget() noexcept { computed_.forget(); }

  /// Returns the lanes in which they are enclosed.
  [[nodiscard]] LaneMask defined() noexcept;
  /// Returns a row for each variable: the entries of its derivative.
  [[nodiscard]] ConstIntervalMatrix derivatives() noexcept;
  /// Removes all other lanes from the defined ones.
  void keep(LaneMask lanes) noexcept { defined_ &= lanes; }

 private:
  [[nodiscard]] LaneMask evaluate() noexcept;

  const BoxLanes& lanes_;
  MidpointEvaluator& midpoint_;
  const regulus_kernel& kernel_;
  const ProductForm form_;
  AlignedBuffer derivatives_, of_factor_;
  Once computed_;
  LaneMask defined_ = 0;
};

}  // namespace regulus::detail
