// SPDX-License-Identifier: Apache-2.0
// All poses of a platform on six legs, as the solutions of equations in its rotation and a few more
// numbers. PROOF.md, "All poses, by a search".
#pragma once

#include "runtime/verifier/evaluation.hpp"

namespace regulus::verifier {

inline constexpr std::size_t kCharts = 4;

/// Poses of quaternions whose part number `chart` is 1, and the other parts the first three unknowns.
struct PoseChart {
  /// Six equations at most, of the rotation and some of |t|², Rᵀt and t of a platform in another place. They
  /// hold at all poses of all legs. Variables: none, or the squares of the lengths.
  Question question;
  Box places{};                   ///< of these variables
  Box range{};                    ///< has all poses whose rotation is in the chart
  std::array<NodeId, 3> place{};  ///< x, y, z, by the unknowns

  /// The legs as they are, with the variables of the claim. The unknowns are the rotation, and x, y, z.
  Question legs;
  Box range_of_legs{};
  std::array<NodeId, 7> pose{};  ///< x, y, z and a unit quaternion, by the unknowns of `legs`
};

/// Requires  question.solutions has six legs, and there is no closure. `places` has all values of the variables.
/// Throws    Unfinished if a number of a leg has no certain value, or if fewer numbers are determined by
///           the legs than the equations need.
[[nodiscard]] std::vector<PoseChart> form_pose_equations(const Question& question,
                                                         const Box& places);

}  // namespace regulus::verifier
