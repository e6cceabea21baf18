// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "codegen/question/quantity/quantity.hpp"

namespace regulus::detail {

/// Returns what is bounded: kind, components, the load or the twists, and the data of the motors
/// that it depends on, as exact texts.
[[nodiscard]] nlohmann::ordered_json json_quantity(const Model& model, const Quantity& quantity);

/// Returns the words in bars if the component is bounded by its absolute value, and the words do not say so.
[[nodiscard]] std::string in_bars(const std::string& words, const Component& component);

/// Returns "|force under payload| < 20 N", for example: what a limit asks.
[[nodiscard]] std::string describe_limit(const Quantity& quantity, const GiNaC::ex& limit);

}  // namespace regulus::detail
