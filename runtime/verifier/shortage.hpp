// SPDX-License-Identifier: Apache-2.0
// The power of a load and of forces along a direction, in Arb. PROOF.md, "INFEASIBLE".
#pragma once

#include <optional>

#include "runtime/verifier/ball.hpp"
#include "runtime/verifier/load_lines.hpp"

namespace regulus::verifier {

/// Encloses a vector near y along which no force without limits has power: Fy = 0 for their rows F of A,
/// which is given row by row. nullopt if none is certain.
[[nodiscard]] std::optional<std::vector<Ball>> without_free_forces(const Question& question,
                                                                   const std::vector<Ball>& A,
                                                                   const std::vector<double>& y,
                                                                   long bits);

/// Encloses the greatest yᵀw of the wrenches w of the load; nullopt if a value is not certain.
[[nodiscard]] std::optional<Ball> need_along(const Question& question, const std::vector<Ball>& y,
                                             long bits);

/// Encloses the greatest fᵀAy of the forces f within the limits; nullopt if a value is not certain.
/// A is given row by row. Forces without limits have no power along y.
[[nodiscard]] std::optional<Ball> gift_along(const Question& question, const std::vector<Ball>& A,
                                             const std::vector<Ball>& y, long bits);

}  // namespace regulus::verifier
