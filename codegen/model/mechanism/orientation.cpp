// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/orientation.hpp"

#include "codegen/model/mechanism/rotation.hpp"

namespace regulus::detail {

std::vector<std::string> orientation_names(Orientation orientation) {
  switch (orientation) {
    case Orientation::kEulerZxz:
      return {"psi", "theta", "phi"};
    case Orientation::kRollPitchYaw:
      return {"roll", "pitch", "yaw"};
    case Orientation::kQuaternion:
      break;
  }
  return {"q0", "q1", "q2", "q3"};
}

ScaledRotation scaled_rotation(Orientation orientation, const std::vector<GiNaC::ex>& q) {
  switch (orientation) {
    case Orientation::kEulerZxz:
      return {rotation_euler_zxz(q[0], q[1], q[2])};
    case Orientation::kRollPitchYaw:
      return {rotation_roll_pitch_yaw(q[0], q[1], q[2])};
    case Orientation::kQuaternion:
      break;
  }
  GiNaC::ex squared_norm = 0;
  for (const GiNaC::ex& component : q) squared_norm += pow(component, 2);
  return {scaled_rotation_quaternion(q[0], q[1], q[2], q[3]), squared_norm};
}

std::vector<TwistComponent> twist_of_platform(const std::string& unit) {
  std::vector<TwistComponent> twist;
  for (const char* name : {"v_x", "v_y", "v_z"})
    twist.push_back({TwistComponent::Kind::kLinear, name, unit});
  for (const char* name : {"w_x", "w_y", "w_z"})
    twist.push_back({TwistComponent::Kind::kAngular, name, "rad"});
  return twist;
}

}  // namespace regulus::detail
