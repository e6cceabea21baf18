// SPDX-License-Identifier: GPL-3.0-or-later
// Orientations that have no exact decimals, as quaternions of decimals next to them.
#pragma once

#include <array>

#include "codegen/model/import/mechanism.hpp"

namespace regulus::detail {

/// w, x, y, z, of any length but zero.
using Quaternion = std::array<double, 4>;

/// The turn about an axis that is not zero.
[[nodiscard]] Quaternion turn_about(const std::array<double, 3>& axis, double angle);

/// Returns the turn by b, then by a.
[[nodiscard]] Quaternion product(const Quaternion& a, const Quaternion& b);

/// Sets the orientation to twelve decimals, and records that it differs from `before`. A turn about
/// a coordinate axis by a multiple of pi/12 becomes that angle.
///
/// Throws    InputError if the tolerance of `numbers` is less than the error, 1e-11.
void set_approx(Pose& pose, const Quaternion& q, const XmlPlace& place, const std::string& before,
                NumberReader& numbers);

/// If the quaternion is a turn about a coordinate axis by a multiple of pi/12, within the tolerance,
/// sets this angle and returns true.
[[nodiscard]] bool set_simple_turn(Pose& pose, const Quaternion& q, double tolerance);

/// True if the components that are not zero are one, two or four, of one magnitude: the turn takes
/// coordinate axes to such, and its matrix is exact.
[[nodiscard]] bool is_turn_of_cube(const std::vector<WrittenNumber>& q);

/// If the quaternion is such a turn within the tolerance, sets it, with components 0 and ±1, and
/// returns true.
[[nodiscard]] bool set_turn_of_cube(Pose& pose, const Quaternion& q, double tolerance);

}  // namespace regulus::detail
