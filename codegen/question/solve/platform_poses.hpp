// SPDX-License-Identifier: GPL-3.0-or-later
// All poses of a platform whose legs have given lengths.
#pragma once

#include "codegen/question/solve/solve_run.hpp"

namespace regulus::detail {

/// In the plane by search; in space by counting (runtime/solutions/gough_poses.hpp). The lengths are
/// those of the motion, or at its pose.
///
/// Requires  request.model.legs: 3 in the plane, or 6 in space; the motion has values.
[[nodiscard]] Solutions solve_platform(const Request& request, const SolveRun& run);

/// Returns the equations of a planar platform as a closure of a model without pose parameters. Its constants
/// have their tolerances, and the squares of the lengths their errors.
[[nodiscard]] Request planar_request(const Request& request);

}  // namespace regulus::detail
