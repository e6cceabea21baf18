// SPDX-License-Identifier: GPL-3.0-or-later
// The meaning of the matrix's columns.
#pragma once

#include <string>
#include <vector>

#include "codegen/model/model.hpp"

namespace regulus {

/// Returns the unit of the first pose parameter that is no angle; "1" if there is none.
[[nodiscard]] std::string length_unit(const Model& model);

/// Returns the components of the twist by column: those that the model names; otherwise the pose
/// parameters, if the matrix has a column for each; otherwise nothing.
[[nodiscard]] std::vector<TwistComponent> twist_of(const Model& model);

}  // namespace regulus
