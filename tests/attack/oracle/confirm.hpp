// SPDX-License-Identifier: GPL-3.0-or-later
// Confirms what a family says of a model, by evaluating the model's own text at points.
#pragma once

#include <optional>
#include <string>

#include "tests/attack/oracle/attack.hpp"

namespace regulus::attack {

/// What speaks against the truth of the attack; nothing if nothing does. `samples`: how many points
/// of the variety are tried where it is regular or empty, corners first.
[[nodiscard]] std::optional<std::string> refute_truth(const Attack& attack, int samples);

/// Whether the ranges and tolerances that the text and the options spell are those of the axes.
[[nodiscard]] std::optional<std::string> refute_axes(const Attack& attack);

}  // namespace regulus::attack
