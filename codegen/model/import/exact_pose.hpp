// SPDX-License-Identifier: GPL-3.0-or-later
// Poses of files as exact frames, and back.
#pragma once

#include "codegen/model/import/mechanism.hpp"
#include "codegen/model/mechanism/placement.hpp"

namespace regulus::detail {

/// Returns the frame that the pose places.
[[nodiscard]] Placement placement_of(const Pose& pose);

/// Returns the pose of a frame: roll, pitch and yaw if they are multiples of pi/12, else the
/// rotation's entries.
[[nodiscard]] Pose pose_of(const Placement& placement);

/// Returns the frame in which `placement` is the reference.
[[nodiscard]] Placement inverse(const Placement& placement);

/// Returns a number of an exact value: a decimal if it has one.
[[nodiscard]] WrittenNumber number_of(const GiNaC::ex& value);

}  // namespace regulus::detail
