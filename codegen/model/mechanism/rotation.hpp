// SPDX-License-Identifier: GPL-3.0-or-later
// Rotation matrices from the mobile to the reference frame.
#pragma once

#include <ginac/ginac.h>

namespace regulus::detail {

/// Rz(psi)·Rx(theta)·Rz(phi): Euler angles, z-x-z.
///
/// Shape     3×3.
/// Source    Merlet, T-RO 2007, §V-B; of the usual conventions, only z-x-z agrees with all its
///           verdicts.
[[nodiscard]] GiNaC::matrix rotation_euler_zxz(const GiNaC::ex& psi, const GiNaC::ex& theta,
                                               const GiNaC::ex& phi);

/// Rz(yaw)·Ry(pitch)·Rx(roll).
///
/// Shape     3×3.
[[nodiscard]] GiNaC::matrix rotation_roll_pitch_yaw(const GiNaC::ex& roll, const GiNaC::ex& pitch,
                                                    const GiNaC::ex& yaw);

/// |q|² times the rotation of the quaternion q0 + q1 i + q2 j + q3 k: polynomials, no division.
///
/// Shape     3×3.
/// Ensures   for every q ≠ 0, the result over |q|² is a rotation, that of q/|q|.
[[nodiscard]] GiNaC::matrix scaled_rotation_quaternion(const GiNaC::ex& q0, const GiNaC::ex& q1,
                                                       const GiNaC::ex& q2, const GiNaC::ex& q3);

}  // namespace regulus::detail
