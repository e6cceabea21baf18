// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/model/drawing.hpp"
#include "codegen/model/mechanism/serial.hpp"

namespace regulus::detail {

/// As compose(), with entries that are not multiplied out: of any size, and not for a matrix.
[[nodiscard]] Placement compose_as_written(const Placement& first, const Placement& second);

/// Returns the links of an arm between the origins of its joints and its tool, the axes, and the frame
/// of the tool.
///
/// Requires  `model` has the pose of the arm.
[[nodiscard]] Drawing serial_drawing(const Model& model, const Serial& robot);

}  // namespace regulus::detail
