// SPDX-License-Identifier: GPL-3.0-or-later
// The list of closures beside a URDF file: FILE.yaml, as collections of parallel robots have it.
#pragma once

#include <string>
#include <string_view>

#include "codegen/model/import/mechanism.hpp"

namespace regulus::detail {

/// Adds to the mechanism
///   closed_loop: [[A, B], …]   pairs of frames, each the name of a link, or of the joint before it
///   type: [6d, …]              by pair: 3d, the origins meet, or 6d, the frames do; 6d if left out
///   name_mot: [JOINT, …]       the driven joints
///   joint_name, joint_type     joints that are SPHERICAL or UJOINT_XY (of axes x and then y)
/// Other keys have no meaning for the kinematics.
///
/// Throws    InputError with the line.
void add_robot_list(Mechanism& mechanism, std::string_view text, const std::string& file);

/// A link of that name, or the link behind a joint of that name; empty if there is none.
[[nodiscard]] std::string link_called(const Mechanism& mechanism, const std::string& name);

}  // namespace regulus::detail
