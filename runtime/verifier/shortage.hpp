// SPDX-License-Identifier: Apache-2.0
// The power of a load and of forces along a direction, in Arb. PROOF.md, "INFEASIBLE".
#pragma once

#include <optional>

#include "runtime/verifier/ball.hpp"
#include "runtime/verifier/load_lines.hpp"

namespace regulus::verifier {

/// Encloses the greatest yᵀw of the wrenches w of the load; nullopt if a value is not certain.
[[nodiscard]] std::optional<Ball> need_along(const Question& question, const std::vector<double>& y,
                                             long bits);

/// Encloses the greatest fᵀAy of the forces f within the limits; nullopt if a value is not certain.
/// A is given row by row.
[[nodiscard]] std::optional<Ball> gift_along(const Question& question, const std::vector<Ball>& A,
                                             const std::vector<double>& y, long bits);

}  // namespace regulus::verifier
