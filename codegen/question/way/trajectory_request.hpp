// SPDX-License-Identifier: GPL-3.0-or-later
// The questions that a motion along a trajectory is cut into.
#pragma once

#include "codegen/model/request.hpp"
#include "codegen/question/way/path_bounds.hpp"

namespace regulus::detail {

/// Returns the question about the box around the whole path and its control errors: its parameters
/// are the moving pose parameters, then those of the motion, and it has no errors of its own.
[[nodiscard]] Request hull_request(const Request& request, const PathBounds& path);

}  // namespace regulus::detail
