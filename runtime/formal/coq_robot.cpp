// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_robot.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "runtime/formal/coq_arm.hpp"
#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/coq_keys.hpp"
#include "runtime/formal/coq_real.hpp"
#include "runtime/formal/known_robot.hpp"
#include "runtime/formal/quantity_reader.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/joint_chain.hpp"
#include "runtime/verifier/model/orientation_reading.hpp"
#include "runtime/verifier/model/section_reading.hpp"
#include "runtime/verifier/model/section_values.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kGoughLegs = 6;
constexpr std::string_view kAxes = "xyz";
constexpr std::array<const char*, 3> kCoordinates = {"first ", "second ", "third "};

class RobotReader : QuantityReader {
 public:
  RobotReader(const Question& question, const CoqModel& model)
      : QuantityReader(question, model),
        motion_("motion." + question.motion + '.'),
        pose_list_(poses_of_file(model.values)) {
    table_ = has_below("gough.") ? "gough." : "legs.";
  }

  RobotOfModel read() {
    require_known_robot(values_, robot_.kind, q_.motion);
    read_threshold();
    read_geometry();
    if (robot_.kind == RobotKind::kArm) read_parts();
    if (robot_.kind == RobotKind::kLegs) read_legs();
    read_parameters();
    read_poses();
    if (robot_.kind == RobotKind::kPlatform) read_anchors();
    read_constraints();
    require_all_read();
    if (is_platform()) robot_.orientation = word(table_ + "orientation", "");
    robot_.is_middle_in_set = is_middle_in_set();
    robot_.own = std::move(own_);
    robot_.names = std::move(names_);
    return std::move(robot_);
  }

 private:
  // What the file may have.

  /// What has not been read may change the set or the robot.
  void require_all_read() const {
    for (const std::string& table :
         {motion_, std::string("gough.base["), std::string("gough.platform["),
          std::string("serial."), std::string("legs.leg[")})
      for (auto place = values_.lower_bound(table);
           place != values_.end() && place->first.starts_with(table); ++place)
        if (!read_.contains(place->first)) refuse_model("the key " + place->first);
  }

  /// A claim without a threshold says nothing about one.
  void read_threshold() {
    const std::string place = motion_ + "alpha";
    const std::string written = has(place) ? text_at(place) : "0";
    robot_.threshold = stated("alpha ").value_or(written);
    if (!q_.has_threshold && robot_.threshold != "0")
      throw Unfinished(
          "the motion of the model file has a threshold, and the certificate has none");
  }

  void read_geometry() {
    const std::string table = "geometry.";
    for (const std::string& name : keys_of(table)) read_constant(table + name, name);
  }

  /// A number, or a list of coordinates: NAME_1, …
  void read_constant(const std::string& place, const std::string& name) {
    const std::string value = has_below(place + '.') ? place + ".value" : place;
    std::vector<std::pair<std::string, std::string>> coordinates;  // place and name
    if (has(value)) coordinates.emplace_back(value, name);
    for (std::size_t i = 0; has(value + index(i)); ++i)
      coordinates.emplace_back(value + index(i), name + '_' + std::to_string(i + 1));
    const bool is_ball = has(place + ".radius");
    const std::string key = place + (is_ball ? ".radius" : ".tolerance");
    const bool is_certain = tolerance_at(key, coordinates.at(0).second) == "0";
    const std::vector<CoqNumber> numbers = read_quantities(coordinates, key, is_ball);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto& [at, own] = coordinates[i];
      scope_[own] = numbers[i].node;
      if (is_certain)
        robot_.constants[own] = at;
      else
        robot_.uncertain.emplace_back(own, numbers[i].node);
    }
  }

  void read_parameters() {
    const std::string table = motion_ + "parameters.";
    std::vector<std::pair<std::string, NodeId>> nodes;
    for (const std::string& name : keys_of(table)) {
      nodes.emplace_back(name, ranged(coq_identifier(name), table + name, name, false));
      robot_.of_certificate[name] = coq_identifier(name);
    }
    for (const auto& [name, node] : nodes) scope_[name] = node;
  }

  /// Values may use the names of ranges.
  void read_poses() {
    for (const SectionPose& pose : pose_list_) read_range(pose.name);
    for (const SectionPose& pose : pose_list_) read_value(pose.name);
  }

  [[nodiscard]] bool is_platform() const { return robot_.kind == RobotKind::kPlatform; }

  /// The names of a platform's pose mean nothing else in Geometry.v.
  [[nodiscard]] std::string identifier(const std::string& name) const {
    return is_platform() ? name : coq_identifier(name);
  }
  [[nodiscard]] std::string commanded_identifier(const std::string& name) const {
    return identifier(name) + (is_platform() ? "_commanded" : "'commanded");
  }

  void read_range(const std::string& name) {
    const std::string place = motion_ + name;
    const bool is_freed = may_differ_ && q_.stated.contains("lower " + name);
    if (!has(place + "[0]") && !is_freed) return;
    const bool in_degrees = degrees_.contains(name);
    read_.insert(place);  // An option may have freed a value.
    const std::string own =
        error_of(name, in_degrees).empty() ? identifier(name) : commanded_identifier(name);
    commanded_[name] = robot_.of_certificate[name] = own;
    scope_[name] = ranged(own, place, name, in_degrees);
  }

  void read_value(const std::string& name) {
    const bool in_degrees = degrees_.contains(name);
    if (!commanded_.contains(name)) {
      values_of_poses_[name] = node_at(motion_ + name, in_degrees);
      commanded_[name] = robot_.of_certificate[name] = text_at(motion_ + name, in_degrees);
    }
    const std::string& commanded = commanded_[name];
    const std::string error = error_of(name, in_degrees);
    const auto value = values_of_poses_.find(name);
    const NodeId node = value == values_of_poses_.end() ? scope_.at(name) : value->second;
    robot_.poses.push_back({name, node, !error.empty()});
    if (!error.empty()) {
      robot_.conditions.push_back("near " + coq_argument(error) + ' ' + coq_argument(commanded) +
                                  ' ' + identifier(name));
      const std::string of_error = of_pose(name + " error");
      robot_.quantities.push_back(
          {identifier(name), witness_of(node),
           of_error.empty() ? "" : coq_real(own_.graph, node, poses_) + " + " + of_error});
    }
    robot_.of_certificate[name + " error"] =
        error.empty() ? "0" : identifier(name) + " - " + coq_argument(commanded);
    const std::string actual = error.empty() ? commanded : identifier(name);
    const bool is_angle = is_platform() || robot_.kind == RobotKind::kLegs;
    robot_.pose.push_back(in_degrees && is_angle ? coq_argument(actual) + "*deg" : actual);
  }

  [[nodiscard]] std::string error_of(const std::string& name, bool in_degrees) {
    const std::string place = motion_ + "error." + name;
    read_.insert(place);
    if (const auto error = stated("error " + name)) return *error;
    return has(place) ? text_at(place, in_degrees) : "";
  }

  // The parts of an arm.

  /// They may use the constants of the file alone.
  void read_parts() {
    robot_.parts = read_coq_parts(
        values_,
        [this](const std::string& place, const std::string& name, bool is_angle) {
          const bool in_degrees = is_angle && is_arm_in_degrees(values_);
          return name.empty() ? text_at(place, in_degrees)
                              : read_part(place, name, is_angle, in_degrees);
        },
        read_);
  }

  /// A length, or an angle in radians: a quantity of the theorem if it has a tolerance.
  std::string read_part(const std::string& place, const std::string& name, bool is_angle,
                        bool in_degrees) {
    const std::string key = is_angle ? "serial.angle_tolerance" : "serial.length_tolerance";
    const char* unit = in_degrees ? "*deg" : "";
    std::string value = text_at(place, in_degrees);
    if (in_degrees) value = coq_argument(value) + unit;
    if (!has(key)) return value;
    const bool is_stated = may_differ_ && (q_.stated.contains("spread " + name) ||
                                           q_.stated.contains("spread " + name + "_error"));
    const std::string tolerance = tolerance_at(key, name);
    const std::string own = tolerance == "0" ? value : coq_identifier(name);
    robot_.of_certificate[name] = own;
    robot_.of_certificate[name + "_error"] =
        tolerance == "0" ? "0" : own + " - " + coq_argument(value);
    if (tolerance == "0") return value;
    robot_.is_geometry_certain = false;
    robot_.conditions.push_back("near " + coq_argument(is_stated ? tolerance : tolerance + unit) +
                                ' ' + coq_argument(value) + ' ' + own);
    static_cast<void>(variable(own, node_of_part(place, in_degrees), of_pose(name)));
    return own;
  }

  NodeId node_of_part(const std::string& place, bool in_degrees) {
    const NodeId node = node_at(place, in_degrees);
    Graph& graph = own_.graph;
    return in_degrees ? graph.add(Op::kMultiply, node, parse("pi/180", {}, graph)) : node;
  }

  // Legs.

  void read_legs() {
    const LegNumbers numbers{[this](const LegNumbers::Places& places, const SectionQuantity& how) {
                               return read_quantities(places, how.tolerance.key, how.is_ball);
                             },
                             [this](const std::string& place) {
                               return CoqNumber{text_at(place), node_at(place)};
                             },
                             own_.graph};
    robot_.chains = read_coq_legs(values_, numbers, read_);
    robot_.orientation = word("legs.orientation", kAngleInPlane);
  }

  // Anchors.

  /// Returns the anchor: a point of the theorem if it has a tolerance, or its coordinates.
  std::string read_anchor(const std::string& side, char letter, std::size_t leg) {
    const std::string place =
        has_below("gough.") ? table_ + side + index(leg) : table_ + "leg" + index(leg) + '.' + side;
    const SectionQuantity written =
        section_quantity(values_, place, {table_ + side + "_tolerance", ""},
                         word(table_ + "tolerance_shape", "box") == "ball");
    std::vector<std::string> coordinates, witnesses;
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
      coordinates.push_back(text_at(written.value + index(axis)));
      witnesses.push_back(witness_of(node_at(written.value + index(axis))));
    }
    const std::string middle = '(' + text_of(coordinates, ", ") + ')';
    const std::string name = letter + std::to_string(leg + 1);
    const std::string tolerance = tolerance_at(written.tolerance.key, name + "_x");
    const bool is_certain = tolerance == "0";
    if (!is_certain && leg >= kGoughLegs) refuse_model("a tolerance of a seventh leg");
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
      const std::string own = name + '_' + kAxes[axis];
      const std::string actual = is_certain ? coordinates[axis] : kCoordinates[axis] + name;
      robot_.of_certificate[own] = actual;
      robot_.of_certificate[own + "_error"] =
          is_certain ? "0" : actual + " - " + coq_argument(coordinates[axis]);
    }
    if (is_certain) return middle;
    robot_.is_geometry_certain = false;
    robot_.conditions.push_back((written.is_ball ? "in_ball " : "in_cube ") +
                                coq_argument(tolerance) + ' ' + middle + ' ' + name);
    std::vector<std::string> at_pose;
    for (const char axis : kAxes) at_pose.push_back(of_pose(name + '_' + axis));
    const bool is_known = std::ranges::find(at_pose, "") == at_pose.end() && !written.is_ball;
    const std::string witness = '(' + text_of(witnesses, ", ") + ')';
    robot_.quantities.push_back(
        {name, witness, is_known ? '(' + text_of(at_pose, ", ") + ')' : "", true});
    return name;
  }

  void read_anchors() {
    std::vector<std::string> base, platform;
    std::size_t legs = has_below("gough.") ? kGoughLegs : 0;
    for (; has_below("legs.leg" + index(legs)); ++legs)
      for (const char* key : {".type", ".range[0]", ".range[1]"})
        read_.insert("legs.leg" + index(legs) + key);
    for (std::size_t i = 0; i < legs; ++i) base.push_back(read_anchor("base", 'a', i));
    for (std::size_t i = 0; i < legs; ++i) platform.push_back(read_anchor("platform", 'b', i));
    for (std::size_t leg = 0; leg < legs; ++leg)
      robot_.legs.push_back({"", '(' + base[leg] + ", " + platform[leg] + ')'});
  }

  /// They are about the commanded pose.
  void read_constraints() {
    for (const auto& [name, node] : values_of_poses_) scope_[name] = node;
    for (std::size_t i = 0; has(motion_ + "constraints" + index(i)); ++i) {
      robot_.conditions.push_back(text_at(motion_ + "constraints" + index(i)) + " <= 0");
      constraints_.push_back(node_at(motion_ + "constraints" + index(i)));
    }
  }

  /// The middle of the ranges may not satisfy the constraints.
  [[nodiscard]] bool is_middle_in_set() const {
    constexpr long kBits = 128;
    const auto middles = evaluate(own_.graph, middles_, {}, kBits);
    if (!middles) return false;
    const auto values = evaluate(own_.graph, constraints_, *middles, kBits);
    return values && std::ranges::all_of(*values, [](const Ball& value) {
             return arb_is_nonpositive(value.get()) != 0;
           });
  }

  const std::string motion_;  ///< "motion.NAME."
  std::string table_;         ///< of a platform
  const std::vector<SectionPose> pose_list_;
  std::map<std::string, NodeId> values_of_poses_;
  std::map<std::string, std::string> commanded_;  ///< by pose parameter
  std::vector<NodeId> constraints_;
};

}  // namespace

RobotOfModel read_robot(const Question& question, const CoqModel& model) {
  return RobotReader(question, model).read();
}

}  // namespace regulus::verifier
