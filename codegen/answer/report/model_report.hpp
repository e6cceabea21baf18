// SPDX-License-Identifier: GPL-3.0-or-later
// The contents of a model, for people and for programs: motions, tolerance groups, loads, twists.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "codegen/model/model.hpp"

namespace regulus {

[[nodiscard]] nlohmann::ordered_json json_model(const Model& model);

[[nodiscard]] std::string format_model(const Model& model);

}  // namespace regulus
