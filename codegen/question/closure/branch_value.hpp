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
//   condition 2         σ_max/σ_min of AC, and sigma-max and sigma-min alone: singular_values.hpp
//   finite error        |p_i − p°_i|, p° the copy of the unknowns without errors
//                       (DerivativesBy::kVariablesAndNominal)
//
// A load within limits has an f of its own: the farthest force is so far beyond its limits, in parts of
// their distance. Every force is within them if f ≤ 0, and some force is not if f > 0.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codegen/question/closure/closed_system.hpp"
#include "codegen/question/closure/singular_values.hpp"
#include "codegen/question/quantity/quantity.hpp"
#include "runtime/existence/branch_rates.hpp"
#include "runtime/existence/branch_tube.hpp"

namespace regulus::detail {

/// The farthest force beyond its limits, or the nearest to one.
struct ForceBeyond {
  std::size_t motor = 0;
  bool is_above = true;         ///< it is about the largest force; otherwise about the least
  Interval force;               ///< encloses the extreme one of the load
  std::vector<Interval> along;  ///< the column of J
};

class BranchValue {
 public:
  /// A load within the limits of the forces.
  ///
  /// Requires  the model has a closure, and limits.
  BranchValue(const Model& model, const VectorSet& load);
  /// Requires  `component` is of the model, which has a closure.
  BranchValue(const Model& model, const Component& component);

  /// The derivatives that it needs.
  [[nodiscard]] static DerivativesBy needed(QuantityKind kind);

  /// Encloses f over a tube: the largest sign·q, or |q|, of all loads and errors; of a quantity whose
  /// least value is asked −q. Unbounded if nothing is known.
  ///
  /// Requires  this is no distance, and has no singular values.
  /// Rounding  outward; MXCSR at nearest.
  [[nodiscard]] Interval largest(const BranchRates& rates, const SystemBoxes::System& over) const;

  /// Null if f is no singular value.
  [[nodiscard]] const SingularValues* singular_values() const {
    return singular_values_ ? &*singular_values_ : nullptr;
  }

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
  /// Requires  this is a load within limits.
  [[nodiscard]] ForceBeyond farthest_beyond(const BranchRates& rates,
                                            const SystemBoxes::System& over) const;

  /// Returns the value of the quantity that f means, or f of a value.
  [[nodiscard]] double value_of(double f) const { return is_negative_ ? -f : f; }
  /// The bracket is that of a least value.
  [[nodiscard]] bool is_least() const { return is_negative_; }

 private:
  /// along·w is within middle ± spread, and these ends are those of wrenches of the load.
  struct Work {
    Interval middle, spread;
  };
  void take_load(const VectorSet& set);
  [[nodiscard]] Work work(std::span<const Interval> along) const;
  [[nodiscard]] Interval of_load(std::span<const Interval> along) const;
  [[nodiscard]] std::vector<Interval> along_motor(const std::vector<Interval>& J,
                                                  std::size_t k) const;
  [[nodiscard]] Interval beyond_limits(const std::vector<Interval>& J, ForceBeyond* farthest) const;
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
  std::optional<SingularValues> singular_values_;
  std::vector<Interval> least_,
      most_;  ///< the limits, by motor; empty: it is no load within limits
};

}  // namespace regulus::detail
