// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_robot.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

#include "runtime/formal/coq_arm.hpp"
#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/coq_keys.hpp"
#include "runtime/formal/coq_real.hpp"
#include "runtime/formal/known_robot.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/file_expressions.hpp"
#include "runtime/verifier/model/section_reading.hpp"
#include "runtime/verifier/model/section_values.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kLegs = 6;
constexpr std::string_view kAxes = "xyz";
constexpr std::array<const char*, 3> kCoordinates = {"first ", "second ", "third "};

class RobotReader : FileKeys {
 public:
  RobotReader(const Question& question, const CoqModel& model)
      : FileKeys(model.values),
        q_(question),
        may_differ_(model.may_differ),
        motion_("motion." + question.motion + '.'),
        degrees_(poses_in_degrees(model.values)),
        pose_list_(poses_of_file(model.values)),
        expressions_(own_, values_, degrees_, hidden_,
                     [](std::string_view, const Scope&) { return kNoNode; }) {
    robot_.kind = kind_of_robot(model.values);
    table_ = has_below("gough.") ? "gough." : "legs.";
    for (std::size_t i = 0; i < q_.variables.size(); ++i)
      of_pose_[q_.variables[i].name] = "quantity v " + std::to_string(i);
  }

  RobotOfModel read() {
    require_known_robot(values_, robot_.kind, q_.motion);
    read_threshold();
    read_geometry();
    if (robot_.kind == RobotKind::kArm) read_parts();
    read_parameters();
    read_poses();
    if (robot_.kind == RobotKind::kPlatform) read_anchors();
    read_constraints();
    require_all_read();
    robot_.orientation = word(table_ + "orientation", "");
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

  // Expressions of the file.

  /// The number or the expression at a place, with the names of the motion.
  [[nodiscard]] NodeId node_at(const std::string& place, bool in_degrees = false) {
    if (!has(place)) throw Unfinished("the model file has no " + place);
    read_.insert(place);
    return expressions_.at(place, scope_, in_degrees);
  }
  [[nodiscard]] std::string text_at(const std::string& place, bool in_degrees = false) {
    const NodeId node = node_at(place, in_degrees);
    const WrittenValue& written = values_.at(place);
    return written.is_string ? coq_real(own_.graph, node, names_)
                             : coq_written_number(written.text, own_.graph);
  }
  [[nodiscard]] std::string witness_of(NodeId node) const {
    return coq_real(own_.graph, node, witnesses_);
  }
  /// A constant of the certificate.
  [[nodiscard]] std::optional<std::string> stated(const std::string& key) {
    const auto found = q_.stated.find(key);
    if (!may_differ_ || found == q_.stated.end()) return std::nullopt;
    return coq_real(own_.graph, parse(found->second.text, {}, own_.graph), {});
  }

  // Quantities.

  /// What a variable of the certificate is at a pose that it names.
  [[nodiscard]] std::string of_pose(const std::string& variable) const {
    const auto found = of_pose_.find(variable);
    if (found == of_pose_.end()) return "";
    return robot_.kind == RobotKind::kMatrix ? of_variable(variable) : found->second;
  }
  /// The name that a proof gives a variable of the certificate.
  [[nodiscard]] std::string of_variable(const std::string& variable) const {
    const std::string name = variable.substr(0, variable.find(' '));
    if (name != variable) return coq_identifier(name) + "'error";
    const auto own = robot_.of_certificate.find(name);
    return own == robot_.of_certificate.end() ? coq_identifier(name) : own->second;
  }

  /// A constant, of the certificate if options may have changed it.
  [[nodiscard]] NodeId end_at(const std::string& place, const std::string& stated_end,
                              bool in_degrees) {
    const auto found = q_.stated.find(stated_end);
    if (!may_differ_ || found == q_.stated.end()) return node_at(place, in_degrees);
    read_.insert(place);
    return parse(found->second.text, {}, own_.graph);
  }

  /// A variable in a range.
  NodeId ranged(const std::string& name, const std::string& place, const std::string& stated_name,
                bool in_degrees) {
    const NodeId lower = end_at(place + "[0]", "lower " + stated_name, in_degrees);
    const NodeId upper = end_at(place + "[1]", "upper " + stated_name, in_degrees);
    const auto text = [&](const std::string& stated_end, const std::string& end) {
      const auto changed = stated(stated_end);
      return changed ? *changed : text_at(end, in_degrees);
    };
    robot_.conditions.push_back(text("lower " + stated_name, place + "[0]") + " <= " + name +
                                " <= " + text("upper " + stated_name, place + "[1]"));
    Graph& graph = own_.graph;
    const NodeId sum = graph.add(Op::kAdd, lower, upper);
    return variable(name, graph.add(Op::kDivide, sum, graph.number("2")), of_pose(stated_name));
  }

  /// Adds a quantity, and returns its node.
  NodeId variable(const std::string& name, NodeId middle, const std::string& of_pose) {
    const std::string witness = coq_real(own_.graph, middle, witnesses_);
    names_.push_back(name);
    middles_.push_back(middle);
    witnesses_.push_back(coq_argument(witness));
    poses_.push_back(coq_argument(of_pose));
    robot_.quantities.push_back({name, witness, of_pose});
    return own_.graph.add(Op::kVariable, int(names_.size()) - 1);
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
    const std::string tolerance = tolerance_at(key, coordinates.at(0).second);
    if (tolerance == "0") {
      for (const auto& [at, own] : coordinates) {
        scope_[own] = node_at(at);
        robot_.of_certificate[own] = text_at(at);
        robot_.constants[own] = at;
      }
      return;
    }
    if (is_ball && coordinates.size() != kAxes.size()) refuse_model("a ball in the plane");
    read_uncertain(coordinates, coq_argument(tolerance), is_ball);
  }

  void read_uncertain(const std::vector<std::pair<std::string, std::string>>& coordinates,
                      const std::string& tolerance, bool is_ball) {
    robot_.is_geometry_certain = false;
    std::vector<std::string> values, names;
    for (const auto& [at, own] : coordinates) {
      values.push_back(text_at(at));
      names.push_back(coq_identifier(own));
      if (!is_ball)
        robot_.conditions.push_back("near " + tolerance + ' ' + coq_argument(values.back()) + ' ' +
                                    names.back());
      robot_.of_certificate[own] = names.back();
      scope_[own] = variable(names.back(), node_at(at), is_ball ? "" : of_pose(own));
      robot_.uncertain.emplace_back(own, scope_[own]);
    }
    if (is_ball)
      robot_.conditions.push_back("in_ball " + tolerance + " (" + text_of(values, ", ") + ") (" +
                                  text_of(names, ", ") + ')');
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
    robot_.pose.push_back(in_degrees && is_platform() ? coq_argument(actual) + "*deg" : actual);
  }

  [[nodiscard]] std::string error_of(const std::string& name, bool in_degrees) {
    const std::string place = motion_ + "error." + name;
    read_.insert(place);
    if (const auto error = stated("error " + name)) return *error;
    return has(place) ? text_at(place, in_degrees) : "";
  }

  /// Returns the tolerance of a quantity of the certificate: the error of an expression has another
  /// name.
  [[nodiscard]] std::string tolerance_at(const std::string& key, const std::string& name) {
    if (has(key)) read_.insert(key);
    for (const std::string& own : {name, name + "_error"}) {
      if (const auto spread = stated("spread " + own)) return *spread;
      if (stated("value " + own)) return "0";
    }
    return has(key) ? text_at(key) : "0";
  }

  // The parts of an arm.

  /// They may use the constants of the file alone.
  void read_parts() {
    robot_.parts = read_coq_parts(
        values_,
        [this](const std::string& place, bool in_degrees) { return text_at(place, in_degrees); },
        read_);
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
    if (!is_certain && leg >= kLegs) refuse_model("a tolerance of a seventh leg");
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
    std::size_t legs = has_below("gough.") ? kLegs : 0;
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

  const Question& q_;
  const bool may_differ_;
  const std::string motion_;  ///< "motion.NAME."
  std::string table_;         ///< of a platform
  const Names degrees_, hidden_;
  const std::vector<SectionPose> pose_list_;
  Question own_;  ///< its graph has the expressions of the file
  FileExpressions expressions_;
  Scope scope_;  ///< constants, parameters, and poses with ranges
  std::map<std::string, NodeId> values_of_poses_;
  std::map<std::string, std::string> commanded_;  ///< by pose parameter
  /// A variable of the certificate at a pose that it names.
  std::map<std::string, std::string> of_pose_;
  /// By the number of a variable of the graph: its name, and values in Coq.
  std::vector<std::string> names_, witnesses_, poses_;
  std::vector<NodeId> middles_;  ///< of their ranges
  RobotOfModel robot_;
  std::vector<NodeId> constraints_;
  std::set<std::string> read_;  ///< places of the file
};

}  // namespace

RobotOfModel read_robot(const Question& question, const CoqModel& model) {
  return RobotReader(question, model).read();
}

}  // namespace regulus::verifier
