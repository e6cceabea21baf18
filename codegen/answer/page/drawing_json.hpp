// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "codegen/model/request.hpp"

namespace regulus::detail {

/// Returns the points and parts of the robot, null if the model gives none: `unit` of lengths, `points` as expressions
/// of the language of certificates in the names of the question and those of `lets`, `parts` with
/// their kinds, rows and numbers of points.
[[nodiscard]] nlohmann::ordered_json json_drawing(const Request& request);

/// Returns the same of a robot that is drawn at solutions: in the names of their values and of joints
/// that are held. Constants have their nominal values, among `lets`. A platform on six legs is turned by the
/// quaternion qw, qx, qy, qz.
[[nodiscard]] nlohmann::ordered_json json_drawing_at_solutions(const Model& model);

}  // namespace regulus::detail
