// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "codegen/question/quantity/quantity.hpp"

namespace regulus {

/// Returns what is bounded: kind, components, the load or the twists, and the data of the motors
/// that it depends on, as exact texts.
[[nodiscard]] nlohmann::ordered_json json_quantity(const Model& model, const Quantity& quantity);

}  // namespace regulus
