// SPDX-License-Identifier: GPL-3.0-or-later
// The contents of a model, for people and for programs: motions, tolerance groups, loads, twists.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "codegen/answer/facts.hpp"
#include "codegen/model/model.hpp"

namespace regulus::detail {

/// Tells motions, tolerance groups, loads and twists.
void tell_contents(const Model& model, Facts& facts);

[[nodiscard]] nlohmann::ordered_json json_model(const Model& model);

[[nodiscard]] std::string format_model(const Model& model);

}  // namespace regulus::detail
