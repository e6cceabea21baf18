// SPDX-License-Identifier: Apache-2.0
// The numbers of a model file in a theorem: quantities in their ranges and tolerances, constants, and
// expressions in them.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/coq_keys.hpp"
#include "runtime/formal/coq_real.hpp"
#include "runtime/formal/coq_robot.hpp"
#include "runtime/verifier/model/file_expressions.hpp"
#include "runtime/verifier/model/section_values.hpp"

namespace regulus::verifier {

/// The reader adds each part to `robot_`.
class QuantityReader : protected FileKeys {
 protected:
  QuantityReader(const Question& question, const CoqModel& model)
      : FileKeys(model.values),
        q_(question),
        may_differ_(model.may_differ),
        degrees_(poses_in_degrees(model.values)),
        expressions_(own_, values_, degrees_, hidden_,
                     [](std::string_view, const Scope&) { return kNoNode; }) {
    robot_.kind = kind_of_robot(model.values);
    for (std::size_t i = 0; i < q_.variables.size(); ++i)
      of_pose_[q_.variables[i].name] = "quantity v " + std::to_string(i);
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

  /// Returns the value that a variable of the certificate has at the pose; empty: it has none.
  [[nodiscard]] std::string of_pose(const std::string& variable) const {
    const auto found = of_pose_.find(variable);
    if (found == of_pose_.end()) return "";
    return has_names() ? of_variable(variable) : found->second;
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

  /// Numbers with one tolerance, by their places and names.
  std::vector<CoqNumber> read_quantities(const LegNumbers::Places& coordinates,
                                         const std::string& key, bool is_ball) {
    const std::string tolerance = tolerance_at(key, coordinates.at(0).second);
    if (tolerance != "0") return read_uncertain(coordinates, coq_argument(tolerance), is_ball);
    std::vector<CoqNumber> numbers;
    for (const auto& [at, own] : coordinates) {
      numbers.push_back({text_at(at), node_at(at)});
      robot_.of_certificate[own] = numbers.back().text;
    }
    return numbers;
  }

  std::vector<CoqNumber> read_uncertain(const LegNumbers::Places& coordinates,
                                        const std::string& tolerance, bool is_ball) {
    if (is_ball && coordinates.size() != kInSpace) refuse_model("a ball in the plane");
    robot_.is_geometry_certain = false;
    std::vector<std::string> values, names;
    std::vector<CoqNumber> numbers;
    for (const auto& [at, own] : coordinates) {
      values.push_back(text_at(at));
      names.push_back(coq_identifier(own));
      if (!is_ball)
        robot_.conditions.push_back("near " + tolerance + ' ' + coq_argument(values.back()) + ' ' +
                                    names.back());
      robot_.of_certificate[own] = names.back();
      numbers.push_back(
          {names.back(), variable(names.back(), node_at(at), is_ball ? "" : of_pose(own))});
    }
    if (is_ball)
      robot_.conditions.push_back("in_ball " + tolerance + " (" + text_of(values, ", ") + ") (" +
                                  text_of(names, ", ") + ')');
    return numbers;
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

  /// The proof gives names to parts of the matrix.
  [[nodiscard]] bool has_names() const {
    return robot_.kind == RobotKind::kMatrix || robot_.kind == RobotKind::kLegs;
  }

  static constexpr std::size_t kInSpace = 3;

  const Question& q_;
  const bool may_differ_;
  const Names degrees_, hidden_;
  Question own_;  ///< its graph has the expressions of the file
  FileExpressions expressions_;
  Scope scope_;  ///< constants, parameters, and poses with ranges
  /// A variable of the certificate at a pose that it names.
  std::map<std::string, std::string> of_pose_;
  /// By the number of a variable of the graph: its name, and values in Coq.
  std::vector<std::string> names_, witnesses_, poses_;
  std::vector<NodeId> middles_;  ///< of their ranges
  RobotOfModel robot_;
  std::set<std::string> read_;  ///< places of the file
};

}  // namespace regulus::verifier
