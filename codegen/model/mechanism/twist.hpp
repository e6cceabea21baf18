// SPDX-License-Identifier: GPL-3.0-or-later
// The meaning of the matrix's columns.
#pragma once

#include <string>
#include <vector>

#include "codegen/model/model.hpp"

namespace regulus::detail {

/// Returns the unit of the first pose parameter, or else unknown of a closure, that is no angle; "1" if
/// there is none.
[[nodiscard]] std::string length_unit(const Model& model);

/// Returns the components of the twist by column: those that the model names; otherwise the pose
/// parameters, if the matrix has a column for each; otherwise nothing. Of a closure: its unknowns.
[[nodiscard]] std::vector<TwistComponent> twist_of(const Model& model);

/// Returns the units of a twist in time, by component: "cm/s".
[[nodiscard]] std::vector<std::string> units_of_rates(const std::vector<TwistComponent>& twist);

/// Returns the units of a wrench on the platform, by component of its twist: "N", and of a moment "N cm"; "1"
/// where the model does not say.
[[nodiscard]] std::vector<std::string> units_of_wrench(const Model& model,
                                                       const std::vector<TwistComponent>& twist);

/// Returns the unit of the product of a wrench and a twist, "N cm"; "1" if the model does not say.
[[nodiscard]] std::string unit_of_work(const Model& model);

}  // namespace regulus::detail
