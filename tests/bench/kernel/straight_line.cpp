// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/kernel/straight_line.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "codegen/kernel/cpp/literal.hpp"
#include "codegen/kernel/program/rational_bounds.hpp"

namespace regulus::detail::bench {
namespace {

/// Returns the name of the value of a node, or the text of a leaf.
std::string operand(const Program& program, NodeId id) {
  const Node& node = program.nodes[id];
  if (node.op == Op::kInput) return fmt::format("v[{}]", node.index);
  if (node.op == Op::kPoint) return fmt::format("k[{}]", node.index);
  if (node.op == Op::kConstant) {
    const Interval value = enclose(program.constants[node.index]);
    if (is_thin(value)) return literal(value.lo);
  }
  return fmt::format("t{}", id);
}

bool is_leaf(const Program& program, NodeId id) { return operand(program, id)[0] != 't'; }

std::string right_side(const Program& program, const Node& node) {
  const auto a = [&] { return operand(program, node.a); };
  const auto b = [&] { return operand(program, node.b); };
  switch (node.op) {
    case Op::kConstant: {
      const Interval value = enclose(program.constants[node.index]);
      return fmt::format("a.constant({}, {})", literal(value.lo), literal(value.hi));
    }
    case Op::kNegate:
    case Op::kSin:
    case Op::kCos:
      return fmt::format("a.{}({})", op_name(node.op), a());
    case Op::kAdd:
    case Op::kSubtract:
    case Op::kMultiply:
      return fmt::format("a.{}({}, {})", op_name(node.op), a(), b());
    default:
      break;
  }
  throw std::invalid_argument(fmt::format("no arithmetic has '{}'", op_name(node.op)));
}

}  // namespace

std::string straight_line_text(const Program& program, const std::string& name) {
  std::string text = fmt::format(
      "// Generated: {} operations.\n#pragma once\n\ntemplate <class A>\nvoid {}(A& a, const "
      "typename A::Number* v, const double* k,\n    typename A::Number* out) {{\n",
      program.nodes.size(), name);
  for (NodeId id = 0; id < program.nodes.size(); ++id)
    if (!is_leaf(program, id))
      text += fmt::format("  const auto& t{} = {};\n", id, right_side(program, program.nodes[id]));
  for (std::size_t i = 0; i < program.outputs.size(); ++i)
    text += fmt::format("  out[{}] = {};\n", i, operand(program, program.outputs[i]));
  return text + "}\n";
}

}  // namespace regulus::detail::bench
