// SPDX-License-Identifier: GPL-3.0-or-later
// A place on a piece of a trajectory, for people and for programs.
#pragma once

#include <string>

#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/bound/attained_place.hpp"

namespace regulus::detail {

/// Returns the place with the segment, the pose and the values. `prepared`, `result`: of a search on
/// that piece; `parameter`: as for attained_place(). `has_values`: with those of uncertain
/// quantities; without, the place is singular whatever the load.
[[nodiscard]] AttainedPlace place_on_way(const Trajectory& trajectory, std::size_t piece,
                                         const PreparedSearch& prepared, const Result& result,
                                         const std::string& parameter, bool has_values = true);

}  // namespace regulus::detail
