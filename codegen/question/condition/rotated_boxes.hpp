// SPDX-License-Identifier: GPL-3.0-or-later
// A matrix over boxes, seen from the singular vectors at their centres.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codegen/question/condition/rotated_matrix.hpp"
#include "codegen/question/engine/box_matrices.hpp"

namespace regulus::detail {

/// B(x) = UᵀA(x)V over a box: some number in `center` + Σ_k one in slopes[k]·δ_k + a rest, |δ_k| ≤
/// radius[k].
struct RotatedBox {
  std::size_t rows = 0, columns = 0;
  RoundMatrix center;
  std::vector<RoundMatrix> slopes;
  std::vector<double> radius;
  /// By variable, row-major: their sum bounds the rest. Empty: there is none.
  std::vector<std::vector<double>> rest;
  Distortion distortion{};
};

/// Returns B for a matrix with slopes; nullopt if a number is not finite.
[[nodiscard]] std::optional<RotatedBox> rotate(const BoxMatrix& box, std::size_t rows,
                                               std::size_t columns);

/// Evaluates a kernel over eight boxes. Each thread has its own.
///
/// A kernel with derivatives of the matrix gives slopes. One with an expansion of K·A, in which no
/// quantity has a row of its own, gives Taylor's expansion to second order: with Û ≈ Uᵀ for K,
///
///     B(x) ∈ UᵀA(c)V + Σ_k (Û∂_kA(c))V·δ_k + Σ_p<q (Û∂²_pqA)V·δ_pδ_q + ½Σ_p (Û∂²_ppA)V·δ_p² + F,
///
/// in which the second derivatives are enclosed over the box. Their sums over rows cancel before
/// they are enclosed, so that they are much narrower than slopes. K must be on a grid, so Û is not
/// Uᵀ. Let e be the greatest length of a row of Uᵀ − Û, and W = Û(A(x) − A(c))V. Then
/// F = (Uᵀ − Û)Û⁻¹W, and |F_ij| ≤ e·|Û⁻¹|·Σ_l|W_lj|.
class RotatedBoxes {
 public:
  using Box = BoxMatrices::Box;

  /// Requires  the kernel of `problem` is of one of the two kinds.
  RotatedBoxes(const Problem& problem, const MatrixScaling& scaling);

  /// Rounding  outward; MXCSR at nearest.
  void evaluate(std::span<const Box> boxes);
  /// Returns nullopt if the matrix is not certainly defined all over the box, or not bounded.
  [[nodiscard]] std::optional<RotatedBox> rotated(std::size_t lane) const;
  /// The boxes of the last evaluate().
  [[nodiscard]] BoxMatrices& matrices() noexcept { return matrices_; }

 private:
  /// The facts about K in one lane.
  struct Factor {
    std::optional<SingularVectors> vectors{};
    double error = kInfinity;  ///< e·|Û⁻¹|
  };

  /// The kernel has no expansion of K·A: it was too costly, or nothing varies.
  [[nodiscard]] bool is_plain() const {
    return matrices_.kernel().functions().expansion == nullptr;
  }
  [[nodiscard]] const regulus_expansion& expansion() const {
    return *matrices_.kernel().functions().expansion;
  }
  void choose_factor(std::size_t lane);
  [[nodiscard]] std::vector<double> on_grid(const SingularVectors& vectors) const;
  void call_parts();
  [[nodiscard]] std::vector<std::vector<Interval>> derivatives(
      const regulus_derivatives& of, const std::vector<AlignedBuffer>& values, std::size_t lane,
      bool second) const;

  const MatrixScaling& scaling_;
  const std::size_t m_, n_, variables_, parts_;
  BoxMatrices matrices_;
  std::size_t count_ = 0;
  std::vector<Factor> factors_;
  std::vector<AlignedBuffer> K_, first_, second_;  ///< by part: n rows of Û
  LaneMask defined_ = 0;
};

}  // namespace regulus::detail
