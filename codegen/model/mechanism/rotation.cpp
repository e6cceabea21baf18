// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/rotation.hpp"

namespace regulus::detail {
namespace {

using GiNaC::cos;
using GiNaC::ex;
using GiNaC::matrix;
using GiNaC::sin;

}  // namespace

matrix rotation_euler_zxz(const ex& psi, const ex& theta, const ex& phi) {
  const ex c1 = cos(psi), s1 = sin(psi);
  const ex c2 = cos(theta), s2 = sin(theta);
  const ex c3 = cos(phi), s3 = sin(phi);
  return {{c1 * c3 - s1 * c2 * s3, -c1 * s3 - s1 * c2 * c3, s1 * s2},
          {s1 * c3 + c1 * c2 * s3, -s1 * s3 + c1 * c2 * c3, -c1 * s2},
          {s2 * s3, s2 * c3, c2}};
}

matrix rotation_roll_pitch_yaw(const ex& roll, const ex& pitch, const ex& yaw) {
  const ex cr = cos(roll), sr = sin(roll);
  const ex cp = cos(pitch), sp = sin(pitch);
  const ex cy = cos(yaw), sy = sin(yaw);
  return {{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
          {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
          {-sp, cp * sr, cp * cr}};
}

matrix scaled_rotation_quaternion(const ex& q0, const ex& q1, const ex& q2, const ex& q3) {
  const ex s0 = pow(q0, 2), s1 = pow(q1, 2), s2 = pow(q2, 2), s3 = pow(q3, 2);
  return {{s0 + s1 - s2 - s3, 2 * (q1 * q2 - q0 * q3), 2 * (q1 * q3 + q0 * q2)},
          {2 * (q1 * q2 + q0 * q3), s0 - s1 + s2 - s3, 2 * (q2 * q3 - q0 * q1)},
          {2 * (q1 * q3 - q0 * q2), 2 * (q2 * q3 + q0 * q1), s0 - s1 - s2 + s3}};
}

}  // namespace regulus::detail
