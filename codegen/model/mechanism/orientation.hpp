// SPDX-License-Identifier: GPL-3.0-or-later
// The orientation of a platform by pose parameters, and its twist.
#pragma once

#include <string>
#include <vector>

#include "codegen/model/model.hpp"

namespace regulus::detail {

/// The description of the platform's orientation, with the names of its pose parameters.
enum class Orientation {
  kEulerZxz,      ///< psi theta phi, R = Rz(psi)·Rx(theta)·Rz(phi)
  kRollPitchYaw,  ///< roll pitch yaw, R = Rz(yaw)·Ry(pitch)·Rx(roll)
  kQuaternion,    ///< q0 q1 q2 q3, R the rotation of q/|q|
};

/// The rotation as S/N, with S = N·R free of divisions.
struct ScaledRotation {
  GiNaC::matrix S;
  GiNaC::ex N = 1;
};

[[nodiscard]] std::vector<std::string> orientation_names(Orientation orientation);

/// Returns the rotation that the parameters describe. Angles are in radians.
///
/// Requires  as many parameters as the orientation has names.
[[nodiscard]] ScaledRotation scaled_rotation(Orientation orientation,
                                             const std::vector<GiNaC::ex>& parameters);

/// The velocity of the platform's origin and the angular velocity, both in the reference frame.
[[nodiscard]] std::vector<TwistComponent> twist_of_platform(const std::string& unit);

}  // namespace regulus::detail
