// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the path of a program in G-code (RS274/NGC, LinuxCNC): moves of the position x, y, z.
#pragma once

#include <string>

#include "codegen/model/way/trajectory.hpp"

namespace regulus::detail {

/// True for the endings .gcode, .nc, .ngc, .tap and .gc.
[[nodiscard]] bool is_gcode_file(const std::string& file);

/// Returns the pieces of the moves: straight lines (G0, G1) and arcs of circles (G2, G3) in the
/// plane of G17, G18 or G19, with a straight third coordinate. The model must have x, y and z in
/// units of length; the motion holds the other pose parameters. The path begins where x, y and z
/// are all known.
///
/// Ensures   an arc is exactly a circle about the written centre if both ends are equally far from
///           it; otherwise the difference, at most 0.01 mm or 1/1000 of the radius, is added
///           linearly, as both ends are kept.
/// Errors    InputError with the line for every word that is not known to have no effect on the path
///           (gcode_block.hpp); FileError.
[[nodiscard]] Trajectory read_gcode(const Model& model, const Motion& motion,
                                    const std::string& file);

}  // namespace regulus::detail
