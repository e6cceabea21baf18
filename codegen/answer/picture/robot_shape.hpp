// SPDX-License-Identifier: GPL-3.0-or-later
// The robot in the plane of a map: its base, platform and legs where the map shows the place of one
// of its points. For drawing only.
#pragma once

#include "codegen/answer/picture/picture_options.hpp"
#include "codegen/answer/picture/plot.hpp"
#include "codegen/model/request.hpp"

namespace regulus {

/// Throws UsageError unless all points of the model's drawing are in a plane, and the two parameters
/// along the axes are the coordinates of one of them.
void require_robot_shape(const Request& request, const SearchSubject& subject,
                         const PictureOptions& options);

/// Adds the robot at the middle of all ranges, with a slice at its value, and a larger dot at the
/// place that the map is about. Requires require_robot_shape().
void add_robot_shape(Plot& plot, const PreparedSearch& preparation, const PictureOptions& options,
                     const std::optional<Slice>& slice);

}  // namespace regulus
