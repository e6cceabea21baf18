// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/value_names.hpp"

#include <string_view>

namespace regulus::detail {
namespace {

constexpr std::size_t kLongestPart = 40;

std::string short_part(const std::string& name) {
  return identifier_part(identifier_part(name).substr(0, kLongestPart));
}

std::string point_name(const std::string& name) {
  const std::string part = short_part(name);
  return part.starts_with("k_") ? part : "k_" + part;
}

std::vector<bool> inputs_reach(const Program& program) {
  std::vector<bool> reached;
  for (const Node& node : program.nodes) {
    const int operands = operand_count(node.op);
    reached.push_back(node.op == Op::kInput || (operands >= 1 && reached[node.a]) ||
                      (operands == 2 && reached[node.b]));
  }
  return reached;
}

}  // namespace

ValueNames::ValueNames(const Program& program)
    : program_(program), depends_on_inputs_(inputs_reach(program)), names_(program.nodes.size()) {
  for (const std::string& name : program.inputs)
    inputs_.push_back(table_.take("v_" + short_part(name)));
  for (const std::string& name : program.points) points_.push_back(table_.take(point_name(name)));
}

std::string ValueNames::wanted(NodeId id) {
  const Node& node = program_.nodes[id];
  const bool of_input = operand_count(node.op) == 1 && node.op >= Op::kSqrt &&
                        program_.nodes[node.a].op == Op::kInput;
  if (of_input)
    return std::string(op_name(node.op)) + "_" +
           short_part(program_.inputs[program_.nodes[node.a].index]);
  if (depends_on_inputs_[id]) return "t_" + std::to_string(++last_);
  return "c_" + std::to_string(++last_constant_);
}

const std::string& ValueNames::of(NodeId id) {
  const Node& node = program_.nodes[id];
  if (node.op == Op::kInput) return inputs_[node.index];
  if (node.op == Op::kPoint) return points_[node.index];
  if (names_[id].empty()) names_[id] = table_.take(wanted(id));
  return names_[id];
}

}  // namespace regulus::detail
