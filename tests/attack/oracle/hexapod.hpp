// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the inverse Jacobian of a six-legged platform from its anchors.
#pragma once

#include "tests/attack/oracle/attack.hpp"
#include "tests/attack/oracle/evaluate.hpp"

namespace regulus::detail::attack {

/// Returns the rows (N·n, N·B × n) of the legs, with the rank of J⁻¹: n is not normalised, N > 0 is
/// that of the rotation. Uncertain anchors are the axes a1_x … b6_z; others as in `hexapod`.
[[nodiscard]] Sample sample_of(const Hexapod& hexapod, const Point& point);

/// Returns S = N·R for the orientation's angles or quaternion.
[[nodiscard]] Matrix scaled_rotation(const std::string& orientation, const Point& point);

}  // namespace regulus::detail::attack
