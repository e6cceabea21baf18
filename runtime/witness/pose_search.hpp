// SPDX-License-Identifier: Apache-2.0
// Decides if the constraints leave any pose: branch and prune over the constraints alone. The
// search counts its boxes and uses no clock, so that a search that was interrupted and resumed has
// the same result.
#pragma once

#include <optional>

#include "runtime/problem/problem.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::detail {

/// What is known about the poses that the constraints leave.
struct Inhabitants {
  Occupancy occupancy = Occupancy::kUnknown;
  /// kInhabited: one pose, as in Witness; `determinant` has no meaning.
  std::optional<WitnessPoint> point;
};

/// Requires  find_fault finds none; rounding to nearest.
/// Ensures   kEmpty: at every point of the true ranges some constraint is certainly positive.
///           kInhabited: at `point`, of the inner ranges, every constraint is certainly ≤ 0.
[[nodiscard]] Inhabitants find_pose(const Problem& problem, const Settings& settings);

/// The same for a point at which the matrix, the row scales and the pose are also certainly
/// defined; kUnknown if none was found.
[[nodiscard]] Inhabitants find_defined_pose(const Problem& problem, const Settings& settings);

}  // namespace regulus::detail
