// SPDX-License-Identifier: GPL-3.0-or-later
// Reports of a check of a trajectory.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "codegen/question/way/trajectory_run.hpp"

namespace regulus {

/// Returns a line with the number of segments, the interpolation and the file, and its notes.
[[nodiscard]] std::string format_path(const Trajectory& trajectory);
/// Returns a line with the control errors; nothing if there are none.
[[nodiscard]] std::string format_tube(const Model& model, const Motion& motion);
/// Returns the file for programs.
[[nodiscard]] nlohmann::ordered_json json_waypoints(const Trajectory& trajectory);
/// Returns "segment 417, t = 3.21 s (way.csv, lines 418 and 419)". `s`: of the place on the piece,
/// nullopt if it is not known.
[[nodiscard]] std::string describe_segment(const Trajectory& trajectory, std::size_t piece,
                                           const std::optional<Interval>& s);
/// Returns the same for programs.
[[nodiscard]] nlohmann::ordered_json json_segment(const Trajectory& trajectory, std::size_t piece,
                                                  const std::optional<Interval>& s);

/// Returns the lines for people, without the verdict.
[[nodiscard]] std::string format_trajectory(const TrajectoryCheck& check,
                                            const SearchOptions& search);
/// Returns the part of them about the question and the work.
[[nodiscard]] std::string format_trajectory_question(const TrajectoryCheck& check,
                                                     SearchOptions search);
/// Returns the part of them about the piece that decides; empty if there is none.
[[nodiscard]] std::string format_deciding_piece(const TrajectoryCheck& check);
/// Returns the claim in words.
///
/// Requires  a deciding piece with its search if the verdict is SINGULARITY.
[[nodiscard]] std::string describe_trajectory_claim(const TrajectoryCheck& check);

[[nodiscard]] nlohmann::ordered_json json_trajectory(const TrajectoryCheck& check,
                                                     const SearchOptions& search);
/// Adds the part of it about the question and the work.
void add_trajectory_question(nlohmann::ordered_json& report, const TrajectoryCheck& check,
                             const SearchOptions& search);

}  // namespace regulus
