// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/exact_pose.hpp"

#include <cmath>
#include <numbers>

#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/mechanism/rotation.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::matrix;

/// True for p/q with no prime in q but 2 and 5.
bool has_decimals(GiNaC::numeric value) {
  value = value.denom();
  for (const long p : {2L, 5L})
    while (GiNaC::irem(value, p).is_zero()) value = GiNaC::iquo(value, p);
  return value.is_equal(1);
}

bool is_identity(const matrix& R) {
  for (unsigned i = 0; i < 3; ++i)
    for (unsigned j = 0; j < 3; ++j)
      if (!is_certainly_zero(R(i, j) - (i == j ? 1 : 0))) return false;
  return true;
}

double approx(const ex& e) { return WrittenNumber{e, ""}.approx(); }

/// Roll, pitch and yaw in twelfths of pi, if the rotation has such.
std::optional<std::array<long, 3>> simple_angles(const matrix& R) {
  const double sine = -approx(R(2, 0));
  const bool level = std::fabs(sine) < 1 - 1e-9;
  const std::array<double, 3> rpy = {level ? std::atan2(approx(R(2, 1)), approx(R(2, 2))) : 0,
                                     std::atan2(sine, std::hypot(approx(R(0, 0)), approx(R(1, 0)))),
                                     level ? std::atan2(approx(R(1, 0)), approx(R(0, 0)))
                                           : std::atan2(-approx(R(0, 1)), approx(R(1, 1)))};
  std::array<long, 3> twelfths{};
  std::array<ex, 3> angles;
  for (std::size_t i = 0; i < 3; ++i) {
    twelfths[i] = std::lround(rpy[i] * 12 / std::numbers::pi);
    angles[i] = twelfths_of_pi(twelfths[i]).value;
  }
  const matrix candidate = rotation_roll_pitch_yaw(angles[0], angles[1], angles[2]);
  for (unsigned i = 0; i < 3; ++i)
    for (unsigned j = 0; j < 3; ++j)
      if (!is_certainly_zero(R(i, j) - candidate(i, j))) return std::nullopt;
  return twelfths;
}

}  // namespace

WrittenNumber number_of(const ex& value) {
  if (GiNaC::is_a<GiNaC::numeric>(value) && has_decimals(GiNaC::ex_to<GiNaC::numeric>(value)))
    return {value, decimal_text(GiNaC::ex_to<GiNaC::numeric>(value))};
  return {value, formula_text(value)};
}

Placement placement_of(const Pose& pose) {
  Placement result;
  for (std::size_t i = 0; i < 3; ++i) result.p[i] = pose.xyz[i].value;
  const auto& a = pose.angles;
  if (pose.orientation == OrientationForm::kRpy)
    result.R = rotation_roll_pitch_yaw(a[0].value, a[1].value, a[2].value);
  if (pose.orientation == OrientationForm::kQuaternion) {
    ex square = 0;
    for (const WrittenNumber& x : a) square += pow(x.value, 2);
    result.R = scaled_rotation_quaternion(a[0].value, a[1].value, a[2].value, a[3].value)
                   .mul_scalar(1 / square);
  }
  if (pose.orientation == OrientationForm::kRotation)
    for (unsigned i = 0; i < 9; ++i) result.R(i / 3, i % 3) = a[i].value;
  for (unsigned i = 0; i < 9; ++i) result.R(i / 3, i % 3) = reduced(result.R(i / 3, i % 3));
  return result;
}

Pose pose_of(const Placement& placement) {
  Pose pose;
  for (std::size_t i = 0; i < 3; ++i) pose.xyz[i] = number_of(reduced(placement.p[i]));
  if (is_identity(placement.R)) return pose;
  if (const auto angles = simple_angles(placement.R)) {
    pose.orientation = OrientationForm::kRpy;
    for (const long k : *angles) pose.angles.push_back(twelfths_of_pi(k));
    return pose;
  }
  pose.orientation = OrientationForm::kRotation;
  for (unsigned i = 0; i < 9; ++i)
    pose.angles.push_back(number_of(reduced(placement.R(i / 3, i % 3))));
  return pose;
}

Placement inverse(const Placement& placement) {
  Placement result;
  result.R = placement.R.transpose();
  result.p = reduced(scaled(-1, times(result.R, placement.p)));
  return result;
}

}  // namespace regulus::detail
