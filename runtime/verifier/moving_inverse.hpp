// SPDX-License-Identifier: Apache-2.0
// K(t)·A(t) = I + E(t), where K(t) follows the inverse of A(t) over a box of the variables t that
// move K: those of the motion, and those that touch several rows. All other variables stay at the
// middles of their ranges here. PROOF.md, "The test", 1, derives the bounds.
#pragma once

#include <optional>
#include <vector>

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/expansion.hpp"
#include "runtime/verifier/linear_algebra.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Matrices are n×n unless another shape is given.
class MovingInverse {
 public:
  /// Adds derivatives to the question's graph. Throws Unfinished if there are too many.
  MovingInverse(Question& question, std::vector<std::size_t> moving);

  /// Returns false if nothing could be bounded: an operation is undefined, or A is nearly singular
  /// at the middle. `box` is thin except in the moving variables. r, rounded upward, is its radius
  /// about `middle`, or 0 for a coordinate of `middle` that is itself an interval.
  [[nodiscard]] bool run(const Box& box, const Box& middle, const std::vector<double>& r);

  [[nodiscard]] const std::vector<std::size_t>& moving() const noexcept { return moving_; }

  // After run; p counts the moving variables. K(t) = (I − Σ τ_pD_p)·K.
  [[nodiscard]] const Matrix& K() const noexcept { return K_; }  ///< n×rows
  [[nodiscard]] const Matrix& D(std::size_t p) const { return D_[p]; }
  [[nodiscard]] const Matrix& X() const noexcept { return X_; }  ///< Σ r_p|D_p|
  [[nodiscard]] const Matrix& P() const noexcept { return P_; }  ///< |E(t)| ≤ P
  [[nodiscard]] const Matrix& e() const noexcept { return e_; }  ///< |E(t)| at the middle
  [[nodiscard]] const Matrix& share(std::size_t p) const { return share_[p]; }  ///< in P; roughly

 private:
  /// C_μ·μ with the derivatives of μ. KC = K·C_μ up to `unsure`; `columns`: those that are not 0.
  struct MovingTerm {
    Term term;
    std::vector<NodeId> first, second;  ///< by variable, by pair
    std::vector<std::size_t> columns;
    Matrix KC, unsure;
    double spread = 0;  ///< Σ r_pr_q times the uncertainty of ∂_p∂_qμ
    double size = 0;    ///< Σ r_pr_q|∂_p∂_qμ|
  };

  void differentiate();
  [[nodiscard]] bool find_inverse();
  [[nodiscard]] bool multiply(MovingTerm& term);
  [[nodiscard]] bool add(const MovingTerm& term, Interval value, Matrix& sum, Matrix& unsure) const;
  [[nodiscard]] bool bound_middle();
  [[nodiscard]] bool bound_slope(std::size_t p, double r);
  [[nodiscard]] bool bound_pair(std::size_t p, std::size_t q, double weight);
  void subtract_product(const Matrix& D, const Matrix& B);
  void add_remainders();

  Question& q_;
  const std::size_t n_;
  const std::vector<std::size_t> moving_;
  std::vector<MovingTerm> terms_;
  std::optional<Evaluation> at_middle_, over_box_;
  std::vector<double> A_;  ///< row by row

  // For one box.
  Matrix K_, X_, P_, e_;
  Matrix first_;               ///< Σ r_p|B_p − D_p|
  Matrix Z_;                   ///< ½ Σ r_pr_q|∂_p∂_q KA|
  std::vector<Matrix> D_, s_;  ///< B_p = ∂_pKA at the middle = D_p ± s_p
  std::vector<Matrix> share_;
  Matrix C_, unsure_;  ///< of the current pair
};

}  // namespace regulus::verifier
