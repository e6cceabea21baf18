// SPDX-License-Identifier: Apache-2.0
// The poses of a platform on six legs as the solutions of a small system, all over which they can be
// searched for.
//
// A leg of length ρ between a and b means |t + Rb − a|² = ρ². With r = |t|² and s = Rᵀt it is linear:
//
//     r + 2b·s − 2a·t − 2aᵀRb = ρ² − |a|² − |b|².
//
// Elimination gives up to six of the seven numbers r, s, t as affine forms of R and of the others. Where
// all pivots would be small, as they are if base and platform are nearly flat, legs are left. The unknowns
// are R and the other numbers; the equations are the legs that are left, and
//
//     s = Rᵀt,   r = |t|².
//
// They are as many as the unknowns: 10 less the number of pivots. R is the rotation of the quaternion x
// with x_c = 1, and its other parts in [−1, 1] are unknowns: c = 0…3 is the chart. Each rotation is in a
// chart, that of the greatest part of its quaternion.
#pragma once

#include <span>
#include <vector>

#include "runtime/solutions/gough_poses.hpp"
#include "runtime/solutions/pose_forms.hpp"

namespace regulus::detail {

inline constexpr int kChartsOfRotations = 4;

/// Rounding of its functions: outward; MXCSR at nearest.
class PoseEquations {
 public:
  /// Statements about the equations hold for all numbers that the legs enclose.
  explicit PoseEquations(const GoughLegs& legs) : PoseEquations(legs, {}, nullptr) {}

  /// For the poses at which each leg has a square of its length from ρ² + `deviations`: its equation is
  /// that of `legs` with a deviation on the right side.
  PoseEquations(const GoughLegs& legs, const std::array<Interval, 6>& deviations)
      : PoseEquations(legs, deviations, nullptr) {}

  /// With the unknowns of `like`.
  PoseEquations(const GoughLegs& legs, const PoseEquations& like)
      : PoseEquations(legs, {}, &like) {}

  /// False: fewer of the seven numbers are determined than the equations need.
  [[nodiscard]] bool exist() const { return !free_.empty(); }
  [[nodiscard]] std::size_t unknowns() const { return 3 + free_.size(); }
  /// All poses whose rotation is in a chart are in these ranges of the unknowns, not at their ends.
  [[nodiscard]] std::vector<Interval> ranges() const;
  [[nodiscard]] PoseRows rows() const { return {static_cast<int>(unknowns())}; }

  /// Encloses values, derivatives and, if `has_rates`, their derivatives over eight boxes.
  ///
  /// Requires  exist(); pointers aligned to 64 bytes.
  /// Shape     boxes: unknowns() intervals; out: rows().all(). Interval layout of runtime/interval/lanes.hpp.
  /// Ensures   for all deviations; the derivatives are those at a fixed deviation.
  void evaluate(int chart, const double* boxes, double* out, bool has_rates) const;

  /// The same for deviations of 0.
  void evaluate_exact(int chart, const double* boxes, double* out, bool has_rates) const;

  [[nodiscard]] bool have_deviations() const { return have_deviations_; }
  [[nodiscard]] const std::array<Interval, 6>& deviations() const { return deviations_; }
  /// The values at a point are those for deviations of 0 and `bend`, and this matrix times the deviations.
  struct Spread {
    std::vector<Interval> by_deviation;  ///< unknowns() × 6, row-major
    Interval bend;                       ///< of the last value
  };
  [[nodiscard]] Spread spread_at(int chart, std::span<const Interval> point) const;

  /// Returns the pose of the values of the unknowns, in the lengths of the legs that were given.
  [[nodiscard]] GoughPose pose_of(int chart, std::span<const Interval> values) const;

  /// Returns the quaternion of the values, its part `chart` 1.
  [[nodiscard]] static std::array<Interval, 4> quaternion_of(int chart,
                                                             std::span<const Interval> values);

 private:
  struct Pivot {
    std::size_t row = 0, number = 0;
  };
  class Elimination;

  PoseEquations(const GoughLegs& legs, const std::array<Interval, 6>& deviations,
                const PoseEquations* like);
  void make_forms(const Elimination& elimination);

  PoseForms forms_{}, exact_{};  ///< with deviations, and without
  std::array<Interval, 6> deviations_{};
  bool have_deviations_ = false;
  /// The factors by which deviations change r, s, t, and the forms that are left.
  std::array<std::array<Interval, 6>, 7> number_by_deviation_{};
  std::array<std::array<Interval, 6>, kMostFreeNumbers> left_by_deviation_{};
  std::vector<Pivot> pivots_;
  std::vector<std::size_t> free_;  ///< which of r, s, t
  int exponent_ = 0;
  std::array<double, 3> base_center_{}, platform_center_{};  ///< R and t are between these points
};

}  // namespace regulus::detail
