// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds one component along the way-points of a file.
#pragma once

#include "codegen/question/bound/bound_run.hpp"
#include "codegen/support/time_budget.hpp"

namespace regulus::detail {

/// Brackets the component over all pieces of the trajectory, or compares it with the limit. The
/// matrix B(r) of question/quantity/bordered.hpp is that of every piece, and r a parameter beside s. So the
/// bound holds on a piece if B is regular there for every r up to R, and on the trajectory for the
/// least R of the pieces (question/way/path_bracket.hpp).
///
/// Requires  request.motion has a trajectory.
/// Throws    as bound_quantity().
[[nodiscard]] ComponentBound bound_along_way(const Request& request, const Component& component,
                                             const BoundSettings& settings,
                                             const TimeBudget& budget);

}  // namespace regulus::detail
