// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/gough.hpp"

#include "codegen/model/degrees.hpp"
#include "codegen/model/drawing.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

void add_pose_parameter(Model& model, const std::string& name, const std::string& unit) {
  model.pose.push_back({GiNaC::realsymbol(name), name, unit});
}

ScaledRotation rotation(const Model& model, Orientation orientation) {
  std::vector<ex> parameters;
  for (std::size_t i = 3; i < model.pose.size(); ++i) {
    const PoseParameter& p = model.pose[i];
    parameters.push_back(is_in_degrees(p.unit) ? p.symbol * one_degree() : ex(p.symbol));
  }
  return scaled_rotation(orientation, parameters);
}

/// Row `leg` of N·M: (N(X − a) + Sb, Sb × (X − a)); and its row scale 1/(Nρ).
void set_leg(Model& model, unsigned leg, const ScaledRotation& R, const Point& a, const Point& b) {
  const Point Sb = times(R.S, b);
  Point from_a;
  for (std::size_t i = 0; i < 3; ++i) from_a[i] = model.pose[i].symbol - a[i];
  const Point moment = cross(Sb, from_a);
  model.legs.push_back({a, b, sum(from_a, scaled(1 / R.N, Sb))});
  ex squared_length = 0;
  for (unsigned i = 0; i < 3; ++i) {
    const ex direction = R.N * from_a[i] + Sb[i];
    model.matrix(leg, i) = direction;
    model.matrix(leg, 3 + i) = moment[i];
    squared_length += pow(direction, 2);
  }
  model.row_scale.push_back(pow(squared_length, GiNaC::numeric(-1, 2)));
}

/// `a`, `b`: the anchors.
Drawing drawing_of(const Model& model, const ScaledRotation& R, const std::array<Point, 6>& a,
                   const std::array<Point, 6>& b) {
  const Point origin = {model.pose[0].symbol, model.pose[1].symbol, model.pose[2].symbol};
  Drawing::Part base{Drawing::Kind::kBase, {a.begin(), a.end()}},
      platform{Drawing::Kind::kPlatform, {}};
  for (const Point& anchor : b)
    platform.points.push_back(sum(origin, scaled(1 / R.N, times(R.S, anchor))));
  Drawing drawing{{base, platform}};
  for (int leg = 0; leg < 6; ++leg) {
    const auto i = static_cast<std::size_t>(leg);
    drawing.parts.push_back({Drawing::Kind::kLeg, {a[i], platform.points[i]}, leg});
  }
  return drawing;
}

}  // namespace

void add_pose_of_gough(Model& model, const Gough& robot) {
  for (const char* axis : kCoordinates) add_pose_parameter(model, axis, robot.unit);
  const bool angles = robot.orientation != Orientation::kQuaternion;
  for (const std::string& name : orientation_names(robot.orientation))
    add_pose_parameter(model, name, angles ? robot.angle_unit : "1");
}

void add_matrix_of_gough(Model& model, const Gough& robot) {
  const ScaledRotation R = rotation(model, robot.orientation);
  model.twist = twist_of_platform(robot.unit);
  model.motors.emplace();
  for (std::size_t leg = 1; leg <= 6; ++leg) model.motors->push_back({leg, robot.unit});
  model.matrix = GiNaC::matrix(6, 6);
  for (unsigned leg = 0; leg < 6; ++leg)
    set_leg(model, leg, R, robot.base[leg], robot.platform[leg]);
  if (robot.orientation == Orientation::kQuaternion) model.must_be_defined.push_back(pow(R.N, -1));
  model.drawing = std::make_shared<Drawing>(drawing_of(model, R, robot.base, robot.platform));
}

}  // namespace regulus::detail
