// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/serial_drawing.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using Kind = Drawing::Kind;

/// The turn by an angle about a unit vector through the origin (Rodrigues).
GiNaC::matrix turn_about(const Point& axis, const ex& angle) {
  const ex c = cos(angle), s = sin(angle);
  GiNaC::matrix R(3, 3);
  for (unsigned i = 0; i < 3; ++i)
    for (unsigned j = 0; j < 3; ++j) R(i, j) = (1 - c) * axis[i] * axis[j] + (i == j ? c : ex(0));
  for (unsigned i = 0; i < 3; ++i) {
    const unsigned j = (i + 1) % 3, k = (i + 2) % 3;
    R(j, i) += s * axis[k];
    R(i, j) -= s * axis[k];
  }
  return R;
}

Placement motion_of(const SerialJoint& joint, const ex& value) {
  if (joint.kind == JointKind::kRevolute) return {turn_about(joint.axis, value), {0, 0, 0}};
  Placement slide;
  slide.p = scaled(value, joint.axis);
  return slide;
}

}  // namespace

Placement compose_as_written(const Placement& first, const Placement& second) {
  return {first.R.mul(second.R), sum(times(first.R, second.p), first.p)};
}

Drawing serial_drawing(const Model& model, const Serial& robot) {
  const std::vector<ex> values = joint_values(model, robot);
  Drawing drawing;
  Placement frame;
  const auto advance = [&](const Placement& by, Kind kind) {
    const Point from = frame.p;
    frame = compose_as_written(frame, by);
    drawing.parts.push_back({kind, {from, frame.p}});
  };
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const SerialJoint& joint = robot.joints[j];
    advance(joint.origin, Kind::kLink);
    drawing.parts.push_back({Kind::kJoint, {frame.p, sum(frame.p, times(frame.R, joint.axis))}});
    const Placement by = motion_of(joint, values[j]);
    if (joint.kind == JointKind::kPrismatic)
      advance(by, Kind::kLeg);
    else
      frame = compose_as_written(frame, by);
  }
  advance(robot.tool, Kind::kLink);
  Drawing::Part tool{Kind::kTool, {frame.p}};
  for (const Point& axis : {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}})
    tool.points.push_back(sum(frame.p, times(frame.R, axis)));
  drawing.parts.push_back(std::move(tool));
  return drawing;
}

}  // namespace regulus::detail
