// SPDX-License-Identifier: GPL-3.0-or-later
// The inverse Jacobian of a six-legged platform, from its anchors.
#pragma once

#include "tests/attack/oracle/attack.hpp"
#include "tests/attack/oracle/evaluate.hpp"

namespace regulus::attack {

/// The rows (N·n, N·B × n) of the legs, n not normalised, N > 0 that of the rotation: same rank as
/// J⁻¹. Uncertain anchors are the axes a1_x … b6_z; those without an axis are as in `hexapod`.
[[nodiscard]] Sample sample_of(const Hexapod& hexapod, const Point& point);

/// S = N·R for the orientation's angles or quaternion.
[[nodiscard]] Matrix scaled_rotation(const std::string& orientation, const Point& point);

}  // namespace regulus::attack
