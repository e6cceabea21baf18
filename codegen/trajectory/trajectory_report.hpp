// SPDX-License-Identifier: GPL-3.0-or-later
// Reports of a check of a trajectory.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "codegen/trajectory/trajectory_run.hpp"

namespace regulus::inline trajectory {

/// Returns the lines for people, without the verdict.
[[nodiscard]] std::string format_trajectory(const TrajectoryCheck& check, SearchOptions search);

[[nodiscard]] nlohmann::ordered_json json_trajectory(const TrajectoryCheck& check,
                                                     const SearchOptions& search);

}  // namespace regulus::trajectory
