// SPDX-License-Identifier: GPL-3.0-or-later
// The value of a quantity over a tube. A = Φ_p, and J = −A⁻¹Φ_q, q the pose parameters, which are the
// motors:
//
//   determinant         |det A|, or det A with its sign
//   condition           ‖AC‖·‖(AC)⁻¹‖ in the maximum norm, C the factors of the columns
//   error of unknown i  Σ_k |J_ik| ε_k, ε the errors of the motors
//   speed of unknown i  Σ_k |J_ik| s_k, s the largest speeds of the motors
//   force of motor k    Σ_i J_ik w_i, w a load on the unknowns
//   deflection          Σ_j G_ij w_j with G = J diag(1/c) Jᵀ, c the stiffness of the motors
//   finite error        |p_i − p°_i|, p° the copy of the unknowns without errors
//                       (DerivativesBy::kVariablesAndNominal)
#pragma once

#include <span>
#include <vector>

#include "codegen/question/closure/closed_system.hpp"
#include "codegen/question/quantity/quantity.hpp"
#include "runtime/existence/branch_rates.hpp"
#include "runtime/existence/branch_tube.hpp"

namespace regulus {

class BranchValue {
 public:
  /// Requires  `component` is of the model, which has a closure.
  BranchValue(const Model& model, const Component& component);

  /// The derivatives that it needs.
  [[nodiscard]] static DerivativesBy needed(QuantityKind kind);

  /// Encloses f over a tube: the largest sign·q, or |q|, of all loads and errors; of a quantity whose
  /// least value is asked −q. Unbounded if nothing is known.
  ///
  /// Rounding  outward; MXCSR at nearest.
  [[nodiscard]] Interval largest(const BranchRates& rates, const SystemBoxes::System& over) const;

  /// True for a finite error: f is the distance of two unknowns, and the tube itself bounds it.
  [[nodiscard]] bool is_distance() const { return kind_ == QuantityKind::kFiniteError; }
  /// Encloses the distance over the part of a tube over a box.
  ///
  /// Requires  is_distance().
  /// Rounding  outward; MXCSR at nearest.
  [[nodiscard]] Interval distance(const BranchTube& tube, std::span<const Interval> box) const;
  /// Returns the corner of the box where it is largest, nearly.
  [[nodiscard]] std::vector<double> farthest(const BranchTube& tube,
                                             std::span<const Interval> box) const;
  /// Returns how much each variable adds to what is not known of the distance.
  [[nodiscard]] std::vector<double> impact_on_distance(const TubeImage& image, std::size_t m) const;

  /// Returns the value of the quantity that f means, or f of a value.
  [[nodiscard]] double value_of(double f) const { return is_negative_ ? -f : f; }
  /// The bracket is that of a least value.
  [[nodiscard]] bool is_least() const { return is_negative_; }

 private:
  [[nodiscard]] Interval of_load(std::span<const Interval> along) const;
  [[nodiscard]] Interval of_motors(const std::vector<Interval>& J) const;
  [[nodiscard]] Interval condition(const BranchRates& rates, const SystemBoxes::System& over) const;
  [[nodiscard]] std::vector<Interval> compliance(const std::vector<Interval>& J) const;

  const QuantityKind kind_;
  const std::size_t row_, column_, unknowns_, motors_;
  const int sign_;
  const bool is_absolute_, is_negative_;
  std::vector<Interval> by_motor_;         ///< errors, speeds or stiffness
  std::vector<Interval> middle_, spread_;  ///< of the load
  struct Ball {
    Interval radius;
    std::vector<std::size_t> members;
  };
  std::vector<Ball> balls_;
  std::vector<Interval> factors_;  ///< of the columns
};

}  // namespace regulus
