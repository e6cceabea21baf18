// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/named_matrix.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/coq_keys.hpp"
#include "runtime/formal/coq_real.hpp"
#include "runtime/formal/unrelated.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/model_expression.hpp"

namespace regulus::verifier {
namespace {

constexpr int kMostOpenNames = 100;

class NamedMatrixReader : FileKeys {
 public:
  NamedMatrixReader(const WrittenValues& values, RobotOfModel& robot, bool of_pose)
      : FileKeys(values), robot_(robot), degrees_(poses_in_degrees(values)), of_pose_(of_pose) {}

  NamedMatrix read(bool has_scales) {
    for (const auto& [name, variable] : robot_.uncertain) add_argument(name, variable, kNoNode);
    for (const CoqPose& pose : robot_.poses) read_argument(pose);
    read_rows();
    for (std::size_t i = 0; has_scales && has("matrix.row_scale" + index(i)); ++i)
      read_number("matrix.row_scale" + index(i), matrix_.scales, matrix_.scale_texts);
    put_in_order();
    return std::move(matrix_);
  }

 private:
  Graph& graph() { return robot_.own.graph; }

  NodeId new_variable(const std::string& identifier) {
    if (std::ranges::find(robot_.names, identifier) != robot_.names.end())
      throw Unfinished("the name '" + identifier.substr(1) +
                       "' has two meanings in the model file");
    robot_.names.push_back(identifier);
    return graph().add(Op::kVariable, int(robot_.names.size()) - 1);
  }

  void add_argument(const std::string& name, NodeId variable, NodeId value) {
    known_[name] = variable;
    const bool is_number = value != kNoNode && !has_variables(graph(), value);
    matrix_.arguments.push_back({coq_identifier(name), variable, value, is_number});
  }
  void read_argument(const CoqPose& pose) {
    const std::string identifier = coq_identifier(pose.name);
    const Node commanded = graph().nodes()[std::size_t(pose.commanded)];
    if (!pose.has_error && commanded.op == Op::kVariable &&
        robot_.names[std::size_t(commanded.a)] == identifier)
      return add_argument(pose.name, pose.commanded, kNoNode);
    NodeId value = pose.has_error ? kNoNode : pose.commanded;
    if (pose.has_error && of_pose_)
      value = graph().add(Op::kAdd, pose.commanded, new_variable(identifier + "'error"));
    add_argument(pose.name, new_variable(identifier), value);
  }

  void read_rows() {
    const auto at = [](std::size_t i, std::size_t j) {
      return "matrix.rows" + index(i) + index(j);
    };
    while (has(at(0, matrix_.columns))) ++matrix_.columns;
    for (; has(at(matrix_.rows, 0)); ++matrix_.rows) {
      for (std::size_t j = 0; j < matrix_.columns; ++j) {
        if (!has(at(matrix_.rows, j))) refuse_model("rows of several lengths");
        read_number(at(matrix_.rows, j), matrix_.entries, matrix_.entry_texts);
      }
      if (has(at(matrix_.rows, matrix_.columns))) refuse_model("rows of several lengths");
    }
  }

  void read_number(const std::string& place, std::vector<NodeId>& nodes,
                   std::vector<std::string>& texts) {
    nodes.push_back(node_at(place));
    texts.push_back(text_of_node(place, nodes.back()));
  }

  [[nodiscard]] std::string text_of_node(const std::string& place, NodeId node) {
    const WrittenValue& written = values_.at(place);
    return written.is_string ? coq_real(graph(), node, robot_.names)
                             : coq_written_number(written.text, graph());
  }

  NodeId node_at(const std::string& place) {
    const WrittenValue& written = values_.at(place);
    if (!written.is_string) return number_of_toml(written.text, graph());
    const NameMeaning of_name = [this](std::string_view name) {
      return meaning(std::string(name));
    };
    return parse_model_expression(written.text, of_name, graph(), depth_, degrees_, false);
  }

  /// A name of [let] comes first, as for the verifier's reader.
  NodeId meaning(const std::string& name) {
    if (has("let." + name)) return named(name, "let." + name);
    if (const auto known = known_.find(name); known != known_.end()) return known->second;
    const auto constant = robot_.constants.find(name);
    if (constant == robot_.constants.end()) throw Unfinished("the name " + name + " is not known");
    return named(name, constant->second);
  }

  /// Constants first, then [let] in the order of the file, or if that is none of dependence, of their
  /// use.
  void put_in_order() {
    const auto number = [this](const MatrixName& name) { return values_.at(name.place).number; };
    std::ranges::stable_sort(matrix_.names, {}, [&](const MatrixName& name) {
      return std::pair(name.is_let, name.is_let ? 0 : number(name));
    });
    std::vector<MatrixName> names = matrix_.names;
    std::ranges::stable_sort(
        names, {}, [&](const MatrixName& name) { return std::pair(name.is_let, number(name)); });
    std::set<NodeId> known;
    for (const MatrixName& name : names) {
      for (const NodeId id : ingredients(graph(), {name.value}))
        if (is_later(id, known, names)) return;
      known.insert(name.variable);
    }
    matrix_.names = std::move(names);
  }
  [[nodiscard]] static bool is_later(NodeId id, const std::set<NodeId>& known,
                                     const std::vector<MatrixName>& names) {
    return !known.contains(id) &&
           std::ranges::find(names, id, &MatrixName::variable) != names.end();
  }

  NodeId named(const std::string& name, const std::string& place) {
    auto& known = place.starts_with("let.") ? lets_ : known_;
    if (const auto found = known.find(name); found != known.end()) return found->second;
    if (++open_ > kMostOpenNames) throw Unfinished("[let] is nested too deeply");
    const NodeId value = node_at(place);
    --open_;
    const NodeId variable = new_variable(coq_identifier(name));
    matrix_.names.push_back(
        {variable, value, text_of_node(place, value), place, place.starts_with("let.")});
    known.emplace(name, variable);
    return variable;
  }

  RobotOfModel& robot_;
  const Names degrees_;
  const bool of_pose_;
  NamedMatrix matrix_;
  std::map<std::string, NodeId> known_, lets_;
  int depth_ = 0, open_ = 0;
};

}  // namespace

NamedMatrix read_named_matrix(const WrittenValues& values, RobotOfModel& robot, bool has_scales,
                              bool of_pose) {
  return NamedMatrixReader(values, robot, of_pose).read(has_scales);
}

}  // namespace regulus::verifier
