// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "runtime/evaluation/closed_form_evaluator.hpp"
#include "runtime/evaluation/expansion_evaluator.hpp"
#include "runtime/evaluation/first_order_bounds.hpp"

namespace regulus::detail {

/// Estimates how much each variable contributes to the failure of a method's test. These are
/// heuristics: they choose where to split and decide nothing.
class ImpactEvaluator {
 public:
  /// All objects that it reads; each must outlive this object.
  struct Sources {
    const BoxLanes& lanes;
    MidpointEvaluator& midpoint;
    MatrixEvaluator& matrix;
    ProductEvaluator& product;
    DerivativeEvaluator& derivatives;
    FirstOrderBounds& first_order;
    std::optional<ExpansionEvaluator>& expansion;
    ClosedFormEvaluator& closed_form;
  };
  ImpactEvaluator(const Sources& sources, const EvaluationPlan& plan, std::size_t order);

  void forget() noexcept;

  /// Returns the spectral radius of T, or of P if there is no T.
  [[nodiscard]] double approx_spectral_radius(std::size_t lane) noexcept;
  /// Returns the right Perron vector of that matrix.
  [[nodiscard]] ConstPointVector approx_right_vector() noexcept;
  /// Returns what each variable adds to the spectral radius of T or, if there is no T, of |NM − I|.
  /// M is the matrix that the method uses, and N inverts its middle: K for A itself, I for a
  /// product with K. For the method closed-form: what it adds to the width of the determinant.
  [[nodiscard]] ConstPointVector approx_impact() noexcept;

 private:
  void find_perron() noexcept;
  [[nodiscard]] LaneNumbers perron_of(ConstPointMatrix bounds) noexcept;
  void approx_distances(PointMatrix P) noexcept;
  void estimate() noexcept;
  void weigh(std::size_t variable, std::size_t entry, const double* magnitude) noexcept;
  void weigh_rows() noexcept;
  void from_derivatives() noexcept;
  void from_fixing() noexcept;
  [[nodiscard]] PerronVectors vectors() noexcept;
  [[nodiscard]] PointVector impact() noexcept;

  const Sources from_;
  const EvaluationPlan plan_;
  const std::size_t order_, columns_, variables_;
  AlignedBuffer right_, left_, impact_, fixed_boxes_, fixed_product_;
  Once perron_known_, impact_known_;
  LaneNumbers approx_spectral_radius_{};
};

}  // namespace regulus::detail
