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

/// `is_linear`: the derivatives of place and lengths by what varies are constant, and rotations do not vary.
///
/// Requires  arm with derivatives.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] VaryingValues varying_values(const ArmAtPlace& arm,
                                           std::span<const Interval> unknowns, bool is_linear);

class ArmTubes {
 public:
  /// Requires  the arm of the request is kWithinTolerances.
  ArmTubes(const Request& request, const std::vector<std::string>& held);

  /// Returns a posture for each geometry, near this one; nullopt: it is not shown. Its center and radius only say where it
  /// is: others may be as near.
  ///
  /// Rounding  as varying_values().
  [[nodiscard]] std::optional<Root> posture_near(std::vector<double> near) const;

 private:
  std::vector<Interval> deviations_;
  bool is_linear_ = false;
  ArmAtPlace nominal_, all_;
};

}  // namespace regulus::detail
