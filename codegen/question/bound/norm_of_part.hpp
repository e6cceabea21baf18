// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "codegen/question/bound/bound_run.hpp"

namespace regulus::detail {

/// Raises the attained end of the norm of a part of the pose to the largest one of a freedom in that
/// part: where |v_x| has a value, the norm of (v_x, v_y, v_z) is at least that value. Does nothing
/// for other components.
///
/// Requires  `others` are of the same quantity and model, without a limit.
void raise_by_freedoms(ComponentBound& norm, std::span<const ComponentBound> others,
                       const Model& model);

}  // namespace regulus::detail
