// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a table of way-points (CSV), and joins them.
#pragma once

#include <string>
#include <vector>

#include "codegen/model/way/trajectory.hpp"
#include "codegen/model/way/waypoint_table.hpp"

namespace regulus::detail {

constexpr std::size_t kLargestWaypointFile = std::size_t{1} << 28;
constexpr std::size_t kMostWaypoints = 1'000'000;

/// Returns the pieces between the rows of the file, in the interpolation that the motion asks for.
///
/// Ensures   linear: the straight line. hermite: the cubic with the given values and derivatives.
///           cubic: the same with slopes that are those of the natural spline with continuous
///           second derivatives, rounded to doubles; the trajectory is the exact cubic with these
///           slopes, so its second derivatives agree to rounding.
/// Errors    InputError with the line of the file; FileError.
[[nodiscard]] Trajectory read_waypoints(const Model& model, const Motion& motion,
                                        const std::string& file);

/// Returns what the numbers of a column are multiplied with, for this unit. Throws InputError for a unit
/// of another kind.
[[nodiscard]] GiNaC::ex column_factor(const WaypointTable& table, std::size_t column,
                                      const std::string& unit, const std::string& file);

/// Adds a note about columns that are not used. Throws InputError if the name of one is nearly that of a
/// `missing` one; `noun`: what they are.
void note_unused(const WaypointTable& table, const std::vector<bool>& used,
                 const std::vector<std::string>& missing, const std::string& noun,
                 const std::string& file, std::vector<std::string>& notes);

/// Returns the value of a pose parameter that a motion holds. Throws InputError with `remedy` if it
/// is not constant there.
[[nodiscard]] GiNaC::ex held_value(const Model& model, const Motion& motion, std::size_t parameter,
                                   const std::string& file, int line, const std::string& remedy);

}  // namespace regulus::detail
