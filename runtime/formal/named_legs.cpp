// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/named_legs.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/unrelated.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/orientation_reading.hpp"

namespace regulus::verifier {
namespace {

class LegNamer {
 public:
  LegNamer(RobotOfModel& robot, bool in_degrees, bool of_pose)
      : robot_(robot), algebra_(robot.own.graph) {
    for (const CoqPose& pose : robot.poses) scope_[pose.name] = actual(pose, of_pose);
    const OrientationNodes R = read_orientation(robot.orientation, scope_, in_degrees, algebra_);
    rotation_ = R.scaled;
    for (VectorNodes& row : rotation_)
      for (NodeId& entry : row) entry = algebra_.quotient(entry, R.size);
    if (robot.pose.size() > 3 || robot.orientation == kAngleInPlane) name_turn(in_degrees);
  }

  NamedMatrix read(bool has_scales) {
    for (std::size_t i = 0; i < robot_.chains.size(); ++i)
      name_leg(robot_.chains[i].values, std::to_string(i + 1));
    for (const auto& [force, moment] : constraints_) add_row(force, moment);
    while (matrix_.scales.size() < matrix_.rows) matrix_.scales.push_back(algebra_.number(1));
    if (!has_scales) matrix_.scales.clear();
    return std::move(matrix_);
  }

 private:
  NodeId new_variable(const std::string& name) {
    if (std::ranges::find(robot_.names, name) != robot_.names.end())
      throw Unfinished("the name '" + name.substr(1) +
                       "' of the model file is one of the proof, too");
    robot_.names.push_back(name);
    return algebra_.graph().add(Op::kVariable, int(robot_.names.size()) - 1);
  }
  NodeId named(const std::string& name, NodeId value) {
    const NodeId variable = new_variable('_' + name);
    matrix_.names.push_back({variable, value, "", "", false, true});
    return variable;
  }
  VectorNodes named(const std::string& letter, const std::string& number, const VectorNodes& v) {
    VectorNodes result{};
    for (std::size_t i = 0; i < v.size(); ++i)
      result[i] = named(letter + '_' + number + '_' + kAxes[i], v[i]);
    return result;
  }

  /// The pose with its error.
  NodeId actual(const CoqPose& pose, bool of_pose) {
    if (!pose.has_error) return pose.commanded;
    const std::string identifier = coq_identifier(pose.name);
    if (!of_pose) return new_variable(identifier);
    return algebra_.graph().add(Op::kAdd, pose.commanded, new_variable(identifier + "'error"));
  }

  /// Cosines and sines of the angles, and the columns of the rotation.
  void name_turn(bool in_degrees) {
    std::map<NodeId, NodeId> angles;
    std::size_t number = 0;
    if (robot_.orientation != "quaternion")
      for (const std::string& name : orientation_names(robot_.orientation)) {
        const NodeId angle = in_degrees ? algebra_.degrees(scope_.at(name)) : scope_.at(name);
        const std::string which = std::to_string(++number);
        if (is_known_angle(algebra_.graph(), angle)) continue;
        name_angle("cos_" + which, algebra_.cosine(angle), angles);
        name_angle("sin_" + which, algebra_.sine(angle), angles);
      }
    MatrixNodes columns = algebra_.transposed(rotation_);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      for (NodeId& entry : columns[i]) entry = replaced(algebra_.graph(), entry, angles);
      columns[i] = named("R", std::to_string(i + 1), columns[i]);
    }
    rotation_ = algebra_.transposed(columns);
  }

  void name_angle(const std::string& name, NodeId value, std::map<NodeId, NodeId>& angles) {
    if (algebra_.graph().nodes()[std::size_t(value)].op != Op::kConstant)
      angles[value] = named(name, value);
  }

  void name_leg(const LegValues& leg, const std::string& number) {
    VectorNodes position = algebra_.zero();
    for (std::size_t i = 0; i < (leg.is_planar ? 2 : 3); ++i)
      position[i] = scope_.at(std::string(1, kAxes[i]));
    const VectorNodes r = named("r", number, algebra_.product(rotation_, leg.platform));
    const VectorNodes e =
        named("e", number, algebra_.difference(algebra_.sum(position, r), leg.base));
    VectorNodes rod = e;
    if (leg.kind == LegKind::kCrank) rod = name_crank(leg, number, e);
    if (leg.kind == LegKind::kSlider) rod = name_carriage(leg, number, e);
    if (leg.kind == LegKind::kTelescopic) name_length(number, e);
    add_row(rod, algebra_.cross(r, rod));
    if (leg.is_hinged) constraints_.emplace_back(leg.hinge, algebra_.cross(r, leg.hinge));
    if (leg.keeps_orientation) constraints_.emplace_back(algebra_.zero(), moment(leg, e, rod));
  }

  VectorNodes moment(const LegValues& leg, const VectorNodes& e, const VectorNodes& rod) {
    if (leg.kind != LegKind::kTelescopic) return algebra_.cross(leg.bar, rod);
    return across(leg, e);
  }
  VectorNodes across(const LegValues& leg, const VectorNodes& e) {
    return algebra_.difference(algebra_.scaled(leg.size, e),
                               algebra_.scaled(algebra_.dot(e, leg.axis), leg.axis));
  }

  VectorNodes name_crank(const LegValues& leg, const std::string& number, const VectorNodes& e) {
    const VectorNodes& n = leg.axis;
    const NodeId square = algebra_.dot(e, e);
    const NodeId q = named("q_" + number, algebra_.difference(algebra_.product(leg.size, square),
                                                              algebra_.square(algebra_.dot(e, n))));
    const NodeId lengths =
        algebra_.difference(algebra_.square(leg.crank), algebra_.square(leg.rod));
    const NodeId twice = algebra_.product(algebra_.number(2), leg.crank);
    const NodeId k = named("k_" + number, algebra_.quotient(algebra_.sum(square, lengths), twice));
    const NodeId w =
        name_root(number, algebra_.difference(q, algebra_.product(leg.size, algebra_.square(k))));
    const VectorNodes side =
        algebra_.scaled(leg.mode ? w : algebra_.negative(w), algebra_.cross(n, e));
    const VectorNodes sum = algebra_.sum(algebra_.scaled(k, across(leg, e)), side);
    const VectorNodes c = named("c", number, algebra_.scaled(algebra_.quotient(leg.crank, q), sum));
    matrix_.scales.push_back(
        algebra_.quotient(algebra_.root(leg.size), algebra_.product(leg.crank, w)));
    return named("d", number, algebra_.difference(e, c));
  }

  VectorNodes name_carriage(const LegValues& leg, const std::string& number, const VectorNodes& e) {
    const NodeId along = algebra_.dot(e, leg.axis);
    const NodeId rest = algebra_.difference(algebra_.dot(e, e), algebra_.square(leg.rod));
    const NodeId w = name_root(
        number, algebra_.difference(algebra_.square(along), algebra_.product(leg.size, rest)));
    const NodeId sum = leg.mode ? algebra_.sum(along, w) : algebra_.difference(along, w);
    const NodeId place = named("t_" + number, algebra_.quotient(sum, leg.size));
    matrix_.scales.push_back(algebra_.quotient(algebra_.root(leg.size), w));
    return named("d", number, algebra_.difference(e, algebra_.scaled(place, leg.axis)));
  }

  void name_length(const std::string& number, const VectorNodes& e) {
    const NodeId w = name_root(number, algebra_.dot(e, e));
    matrix_.scales.push_back(algebra_.quotient(algebra_.number(1), w));
  }
  NodeId name_root(const std::string& number, NodeId square) {
    const NodeId h = named("h_" + number, square);
    return named("w_" + number, algebra_.root(h));
  }

  void add_row(const VectorNodes& force, const VectorNodes& moment) {
    const bool is_planar = robot_.chains.front().values.is_planar;
    std::vector<NodeId> row(force.begin(), force.begin() + (is_planar ? 2 : 3));
    if (robot_.orientation != "point" && is_planar) row.push_back(moment[2]);
    if (robot_.orientation != "point" && !is_planar)
      row.insert(row.end(), moment.begin(), moment.end());
    matrix_.entries.insert(matrix_.entries.end(), row.begin(), row.end());
    matrix_.columns = row.size();
    ++matrix_.rows;
  }

  static constexpr std::string_view kAxes = "xyz";

  RobotOfModel& robot_;
  GraphAlgebra algebra_;
  Scope scope_;
  MatrixNodes rotation_;
  NamedMatrix matrix_;
  std::vector<std::pair<VectorNodes, VectorNodes>> constraints_;
};

}  // namespace

NamedMatrix name_legs(RobotOfModel& robot, bool in_degrees, bool has_scales, bool of_pose) {
  return LegNamer(robot, in_degrees, of_pose).read(has_scales);
}

}  // namespace regulus::verifier
