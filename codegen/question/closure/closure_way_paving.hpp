// SPDX-License-Identifier: GPL-3.0-or-later
// The stretches of way-points along which the branch of a closure is certain.
#pragma once

#include <vector>

#include "codegen/question/closure/closure_way.hpp"
#include "codegen/question/way/trajectory_paving.hpp"

namespace regulus::detail {

/// Returns the stretches of parts in any order that cover each of their pieces; pieces without parts are
/// undecided, for the reason that they were `not_reached`.
///
/// Ensures   they are in order, without gaps.
[[nodiscard]] std::vector<PathStretch> stretches_in_order(std::vector<PathStretch> parts,
                                                          std::size_t pieces, Reason not_reached);

/// Returns the stretches of all pieces: free if they are on the branch, outside, or undecided.
///
/// Requires  a finding of pave_way().
/// Ensures   they are in order, without gaps.
[[nodiscard]] std::vector<PathStretch> stretches_of(const PreparedWay& prepared,
                                                    const WayFinding& found);

}  // namespace regulus::detail
