// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/gough.hpp"

#include "codegen/model/degrees.hpp"
#include "codegen/model/drawing.hpp"

namespace regulus {
namespace {

using GiNaC::ex;

void add_pose_parameter(Model& model, const std::string& name, const std::string& unit) {
  model.pose.push_back({GiNaC::realsymbol(name), name, unit});
}

void add_pose(Model& model, const Gough& robot) {
  for (const char* axis : kCoordinates) add_pose_parameter(model, axis, robot.unit);
  const bool angles = robot.orientation != Orientation::kQuaternion;
  for (const std::string& name : orientation_names(robot.orientation))
    add_pose_parameter(model, name, angles ? robot.angle_unit : "1");
}

/// One side of the robot: its anchors become geometry parameters and, for tolerance balls, balls.
struct Side {
  std::string letter;
  std::string group;
  const std::array<Point, 6>& anchors;
  ex tolerance;
};

/// Returns the anchors as symbols.
std::array<Point, 6> add_side(Model& model, const Side& side, ToleranceShape shape) {
  std::array<Point, 6> symbols;
  for (std::size_t i = 0; i < 6; ++i) {
    ToleranceBall ball{.members = {}, .radius = side.tolerance, .group = side.group};
    const int index = shape == ToleranceShape::kBall ? static_cast<int>(model.balls.size()) : -1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string name = side.letter + std::to_string(i + 1) + "_" + kCoordinates[axis];
      const GiNaC::realsymbol symbol(name);
      symbols[i][axis] = symbol;
      ball.members.push_back(model.geometry.size());
      model.geometry.push_back(
          {symbol, name, side.anchors[i][axis], side.tolerance, side.group, index});
    }
    if (shape == ToleranceShape::kBall) model.balls.push_back(ball);
  }
  return symbols;
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
  using Kind = Drawing::Kind;
  const Point origin = {model.pose[0].symbol, model.pose[1].symbol, model.pose[2].symbol};
  Drawing::Part base{Kind::kBase, {a.begin(), a.end()}}, platform{Kind::kPlatform, {}};
  for (const Point& anchor : b)
    platform.points.push_back(sum(origin, scaled(1 / R.N, times(R.S, anchor))));
  Drawing drawing{{base, platform}};
  for (int leg = 0; leg < 6; ++leg) {
    const auto i = static_cast<std::size_t>(leg);
    drawing.parts.push_back({Kind::kLeg, {a[i], platform.points[i]}, leg});
  }
  return drawing;
}

}  // namespace

Model gough_model(const Gough& robot) {
  Model model;
  model.name = robot.name;
  model.source = robot.source;
  add_pose(model, robot);
  const auto a =
      add_side(model, {"a", "base", robot.base, robot.base_tolerance}, robot.tolerance_shape);
  const auto b = add_side(model, {"b", "platform", robot.platform, robot.platform_tolerance},
                          robot.tolerance_shape);
  const ScaledRotation R = rotation(model, robot.orientation);
  model.twist = twist_of_platform(robot.unit);
  model.matrix = GiNaC::matrix(6, 6);
  for (unsigned leg = 0; leg < 6; ++leg) set_leg(model, leg, R, a[leg], b[leg]);
  if (robot.orientation == Orientation::kQuaternion) model.must_be_defined.push_back(pow(R.N, -1));
  model.drawing = std::make_shared<Drawing>(drawing_of(model, R, a, b));
  return model;
}

}  // namespace regulus
