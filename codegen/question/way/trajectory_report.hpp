// SPDX-License-Identifier: GPL-3.0-or-later
// What is told of a check of a trajectory.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "codegen/answer/facts.hpp"
#include "codegen/question/way/trajectory_run.hpp"

namespace regulus::detail {

/// Tells model, motion, file, what keeps its value, constraints and control errors.
void tell_way(const Request& request, Facts& facts);
/// Tells people which quantities of the geometry are uncertain.
void say_uncertain_geometry(const SearchSubject& subject, Facts& facts);
/// Returns the uncertain quantities of a request along way-points, without control errors.
[[nodiscard]] SearchSubject geometry_along_way(const Request& request);
/// Returns lines about model, motion and the set that a claim is about, along way-points or not.
[[nodiscard]] std::string describe_request(const Request& request);
/// Returns the file for programs.
[[nodiscard]] nlohmann::ordered_json json_waypoints(const Trajectory& trajectory);
/// Returns "segment 417, t = 3.21 s (way.csv, lines 418 and 419)". `s`: of the place on the piece,
/// nullopt if it is not known.
[[nodiscard]] std::string describe_segment(const Trajectory& trajectory, std::size_t piece,
                                           const std::optional<Interval>& s);
/// Returns the same for programs.
[[nodiscard]] nlohmann::ordered_json json_segment(const Trajectory& trajectory, std::size_t piece,
                                                  const std::optional<Interval>& s);

/// Returns s of the witness, or of the box that blocks; nullopt if neither is known.
[[nodiscard]] std::optional<Interval> parameter_of(const DecidingPiece& deciding);

/// Tells the question and the work.
void tell_trajectory_question(const TrajectoryCheck& check, const SearchOptions& search,
                              Facts& facts);
/// Tells programs the whole question, and how it was searched.
void tell_trajectory_work(const TrajectoryCheck& check, const SearchOptions& search, Facts& facts);
/// Tells of the piece that decides: `segment`, `witness`; null if there is none.
void tell_deciding_piece(const TrajectoryCheck& check, Facts& facts);
/// Tells all of it.
void tell_trajectory(const TrajectoryCheck& check, const SearchOptions& search, Facts& facts);

/// Returns "reachable pose that the constraints allow", for example: what a claim is about.
[[nodiscard]] std::string describe_poses_on_way(const TrajectoryCheck& check);
/// Returns the claim in words.
///
/// Requires  a deciding piece with its search if the verdict is SINGULARITY.
[[nodiscard]] std::string describe_trajectory_claim(const TrajectoryCheck& check);

}  // namespace regulus::detail
