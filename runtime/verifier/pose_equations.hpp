// SPDX-License-Identifier: Apache-2.0
// All poses of a platform on six legs, as the solutions of equations in its rotation and a few more
// numbers. PROOF.md, "All poses, by a search".
#pragma once

#include "runtime/verifier/evaluation.hpp"

namespace regulus::verifier {

inline constexpr std::size_t kCharts = 4;

/// The equations for rotations of quaternions whose part number `chart` is 1, and the other parts the
/// first three unknowns. The others are some of |t|², Rᵀt and t of a platform in another place.
struct PoseChart {
  Question question;                ///< with the equations and the unknowns in its closure
  Box range{};                      ///< has all poses whose rotation is in the chart
  std::vector<std::size_t> free{};  ///< the other unknowns: 0 is |t|², 1 to 3 Rᵀt, 4 to 6 t
  std::array<NodeId, 7> pose{};     ///< x, y, z and a unit quaternion, by the unknowns
  std::array<NodeId, 7> numbers{};  ///< |t|², Rᵀt and t, by the unknowns
  /// With the platform's origin at p it is t = p + R·platform − base.
  std::array<double, 3> base{}, platform{};
};

/// The same numbers in all charts.
///
/// Requires  question.solutions has six legs, and there is no closure. `places` has all values of the variables.
/// Throws    Unfinished if a number of a leg has no certain value, or if fewer numbers are determined by
///           the legs than the equations need.
[[nodiscard]] std::vector<PoseChart> form_pose_equations(const Question& question,
                                                         const Box& places);

}  // namespace regulus::verifier
