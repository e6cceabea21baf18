// SPDX-License-Identifier: GPL-3.0-or-later
// Poses and axes from the words of XML attributes.
#pragma once

#include <string>
#include <string_view>

#include "codegen/model/import/mechanism.hpp"

namespace regulus::detail {

/// Reads three lengths. Throws InputError.
[[nodiscard]] std::array<WrittenNumber, 3> read_vector(std::string_view text, const XmlPlace& place,
                                                       NumberReader& numbers);

/// Reads the components of a direction; refuses a vector that is zero. Throws InputError.
[[nodiscard]] std::array<WrittenNumber, 3> read_direction(std::string_view text,
                                                          const XmlPlace& place,
                                                          NumberReader& numbers);

/// Sets the orientation from roll, pitch and yaw.
///
/// Two or more angles that are not multiples of pi/12 become a quaternion of decimals: the entries
/// of its rotation are rational numbers. It differs from the angles' by less than the tolerance of
/// `numbers`, and this is recorded; with the tolerance 0 the angles stay.
void set_rpy(Pose& pose, std::string_view text, AngleUnit unit, const XmlPlace& place,
             NumberReader& numbers);

/// The unit of Euler angles, and their axes: small letters for axes that turn with the body.
struct EulerConvention {
  AngleUnit unit;
  std::string sequence;
};

// Other orientations than by roll, pitch and yaw about coordinate axes become quaternions of
// decimals, and this is recorded. Turns about one coordinate axis remain angles.

void set_euler(Pose& pose, std::string_view text, const EulerConvention& convention,
               const XmlPlace& place, NumberReader& numbers);

/// An axis and an angle about it.
void set_axis_angle(Pose& pose, std::string_view text, AngleUnit unit, const XmlPlace& place,
                    NumberReader& numbers);

/// The x axis, and a vector that gives the y axis together with it.
void set_axes(Pose& pose, std::string_view text, const XmlPlace& place, NumberReader& numbers);

/// The z axis, reached by the smallest turn.
void set_z_axis(Pose& pose, std::string_view text, const XmlPlace& place, NumberReader& numbers);

/// Sets the orientation w, x, y, z.
void set_quaternion(Pose& pose, std::string_view text, const XmlPlace& place,
                    NumberReader& numbers);

}  // namespace regulus::detail
