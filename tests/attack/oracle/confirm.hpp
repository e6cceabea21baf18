// SPDX-License-Identifier: GPL-3.0-or-later
// Confirms the truth that a family states, by evaluating the text of the model at points.
#pragma once

#include <optional>
#include <string>

#include "tests/attack/oracle/attack.hpp"

namespace regulus::detail::attack {

/// Returns a reason against the truth of the attack, or nullopt. `samples`: the number of points of
/// the variety to try, corners first, if the truth is regular or empty.
[[nodiscard]] std::optional<std::string> refute_truth(const Attack& attack, int samples);

/// Checks that the ranges and tolerances in the text and the options are those of the axes.
[[nodiscard]] std::optional<std::string> refute_axes(const Attack& attack);

}  // namespace regulus::detail::attack
