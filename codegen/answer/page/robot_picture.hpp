// SPDX-License-Identifier: GPL-3.0-or-later
// A robot as a small drawing that does not move, for a notebook.
#pragma once

#include <string>

#include "codegen/model/request.hpp"

namespace regulus::detail {

/// Returns the robot at the middle of the motion in SVG, some kilobytes, for people: in doubles. Empty if
/// the model gives no points that follow from its pose, or the motion is along way-points.
[[nodiscard]] std::string robot_picture(const Request& request);

}  // namespace regulus::detail
