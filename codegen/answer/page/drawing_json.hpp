// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "codegen/model/request.hpp"

namespace regulus {

/// Returns the points and parts of the robot, null if the model gives none: `points` as expressions
/// of the language of certificates in the names of the question and those of `lets`, `parts` with
/// their kinds, rows and numbers of points.
[[nodiscard]] nlohmann::ordered_json json_drawing(const Request& request);

}  // namespace regulus
