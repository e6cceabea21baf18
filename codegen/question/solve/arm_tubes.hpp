// SPDX-License-Identifier: GPL-3.0-or-later
// The tube of a posture: where it is while the geometry is anywhere within its tolerances.
//
// The test of branch_tube.hpp, with the deviations of the uncertain quantities as variables. To first order a posture
// follows them; only what is left of second order widens the tube. Without variables each row of the equations would take
// each quantity for another one.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codegen/question/solve/arm_place.hpp"

namespace regulus::detail {

/// The equations of an arm over a box of its unknowns, with derivatives by m quantities that vary, and by n unknowns.
struct VaryingValues {
  std::vector<Interval> value, by_variable, by_unknown;  ///< n, n×m, n×n
  /// By each variable, and then each unknown; as branch_tube.hpp needs them.
  std::vector<Interval> rates_by_variable, rates_by_unknown;
};

/// Requires  arm with derivatives.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] VaryingValues varying_values(const ArmAtPlace& arm,
                                           std::span<const Interval> unknowns);

/// The equations of all unknowns of an arm within its tolerances; at a point it says how each deviation moves them.
class VaryingArm final : public RootSystem {
 public:
  /// Requires  arm.nominal; the arm turns about more than one direction.
  VaryingArm(const ArmAtPlace& arm, bool has_rates)
      : arm_(arm),
        within_(arm.chain, arm.target, has_rates),
        nominal_(arm.nominal->chain, arm.nominal->target) {}

  void evaluate(std::span<const Box> boxes, bool are_rates_needed) override;
  [[nodiscard]] std::optional<Values> at(std::size_t lane) const override;

 private:
  const ArmAtPlace& arm_;
  WholeArm within_, nominal_;
  std::vector<Box> boxes_;
};

/// Returns a posture for each geometry, near this one; nullopt: it is not shown, or the arm is nominal. Its center and radius only say where it
/// is: others may be as near.
///
/// Rounding  as varying_values().
[[nodiscard]] std::optional<Root> varying_posture_near(const ArmAtPlace& arm,
                                                       std::vector<double> near);

}  // namespace regulus::detail
