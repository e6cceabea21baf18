// SPDX-License-Identifier: GPL-3.0-or-later
// The lost twists and the dependent rows, for people and for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "codegen/question/analysis/lost_twist.hpp"

namespace regulus {

/// {"nullity", "singular_values", "twist", "rows"}; the last two are null if nothing is lost, and
/// all of them if J⁻¹ has no value.
[[nodiscard]] nlohmann::ordered_json json_degeneracy(const PreparedSearch& preparation,
                                                     const std::optional<Degeneracy>& degeneracy);

[[nodiscard]] std::string format_degeneracy(const PreparedSearch& preparation,
                                            const std::optional<Degeneracy>& degeneracy);

}  // namespace regulus
