// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/own_pose.hpp"

#include <algorithm>
#include <array>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/degrees.hpp"
#include "runtime/interval/elementary.hpp"
#include "runtime/interval/floating_point_scope.hpp"
#include "runtime/solutions/gough_poses.hpp"

namespace regulus::detail {
namespace {

Interval half_turn() { return enclose_constant(GiNaC::Pi, "pi"); }

Interval all_around() { return hull(-half_turn(), half_turn()); }

/// Encloses the angle of the points (x, y), also across the cut of atan2; all around at the origin.
Interval angle_around(const Interval& y, const Interval& x) {
  if (x.lo > 0 || y.lo > 0 || y.hi < 0) return atan2(y, x);
  if (!(x.hi < 0)) return all_around();
  const Interval beyond = atan2(-y, -x);
  return mid(y) >= 0 ? beyond + half_turn() : beyond - half_turn();
}

Interval length_of(const Interval& x, const Interval& y) { return sqrt(sqr(x) + sqr(y)); }

bool has_angles_of(const Model& model, Orientation orientation) {
  const std::vector<std::string> names = orientation_names(orientation);
  if (model.pose.size() != 3 + names.size()) return false;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (model.pose[3 + i].name != names[i]) return false;
  return true;
}

}  // namespace

OwnPose::OwnPose(const Model& model) {
  if (model.legs.size() != 6) return;
  for (const Orientation one : {Orientation::kEulerZxz, Orientation::kRollPitchYaw})
    if (has_angles_of(model, one)) orientation_ = one;
  for (const PoseParameter& p : model.pose) parameters_.push_back({p.name, p.unit});
}

std::vector<SolvedUnknown> OwnPose::parameters() const { return parameters_; }

/// With R the rotation, by gough_poses.hpp. Of R = Rz(ψ)Rx(θ)Rz(φ) the last column is
/// (sin ψ sin θ, −cos ψ sin θ, cos θ), the last row (sin θ sin φ, sin θ cos φ, cos θ); 0 ≤ θ ≤ π. Of
/// R = Rz(yaw)Ry(pitch)Rx(roll) the first column is (cos yaw cos pitch, sin yaw cos pitch, −sin pitch),
/// the last row (−sin pitch, cos pitch sin roll, cos pitch cos roll); |pitch| ≤ π/2.
std::vector<Interval> OwnPose::angles_at(std::span<const Interval> pose) const {
  const std::array<Interval, 9> R = rotation_matrix({pose[3], pose[4], pose[5], pose[6]});
  if (*orientation_ == Orientation::kEulerZxz)
    return {angle_around(R[2], -R[5]), angle_around(length_of(R[6], R[7]), R[8]),
            angle_around(R[6], R[7])};
  return {angle_around(R[7], R[8]), angle_around(-R[6], length_of(R[0], R[3])),
          angle_around(R[3], R[0])};
}

std::vector<Interval> OwnPose::at(std::span<const Interval> pose) const {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  std::vector<Interval> values(pose.begin(), pose.begin() + 3);
  const Interval degree = enclose_constant(one_degree(), "a degree");
  const std::vector<Interval> angles = angles_at(pose);
  for (std::size_t i = 0; i < angles.size(); ++i)
    values.push_back(is_in_degrees(parameters_[3 + i].unit) ? angles[i] / degree : angles[i]);
  return values;
}

bool OwnPose::is_ambiguous(std::span<const Interval> pose) const {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  const double turn = width_ru(all_around());
  return std::ranges::any_of(angles_at(pose),
                             [turn](const Interval& angle) { return width_ru(angle) >= turn; });
}

}  // namespace regulus::detail
