// SPDX-License-Identifier: GPL-3.0-or-later
// Arms with five joints: they bring the tool to a place, and its z axis to a direction.
#pragma once

#include <string>
#include <vector>

#include "codegen/model/request.hpp"

namespace regulus::detail {

/// Adds a sixth joint to an arm of five that are free, about which its tool may turn: the z axis of the tool. It is
/// the last one, and its parameter of the pose the last one, a deviation. So the place and the direction of this axis
/// are all that is asked of the five. Other requests, and those about arms that turn about one direction alone, stay as
/// they are.
///
/// `held`: joints that keep their values, beside those to which a motion by the tool gives one.
///
/// Throws    UsageError if the last joint turns about this axis, too.
void let_tool_turn(Request& request, const std::vector<std::string>& held);

/// True if it is the joint that has been added.
[[nodiscard]] bool is_turn_of_tool(const Model& model, std::size_t pose);

}  // namespace regulus::detail
