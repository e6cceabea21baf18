// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/constant_text.hpp"

#include <cln/rational_io.h>

#include <sstream>

namespace regulus::detail {
namespace {

constexpr std::size_t kLongest = 40;
constexpr int kDeepest = 8;

const char* sign_of(Op op) {
  switch (op) {
    case Op::kAdd:
      return " + ";
    case Op::kSubtract:
      return " - ";
    case Op::kMultiply:
      return "*";
    case Op::kDivide:
      return "/";
    default:
      return nullptr;
  }
}

/// Returns nothing if the expression is too deep or too long for a reader.
std::string text_of(const Program& program, NodeId id, int depth);

std::string operand_text(const Program& program, NodeId id, int depth) {
  const std::string text = text_of(program, id, depth + 1);
  const bool plain =
      operand_count(program.nodes[id].op) == 0 || sign_of(program.nodes[id].op) == nullptr;
  return text.empty() || plain ? text : "(" + text + ")";
}

std::string rational_text(const cln::cl_RA& value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string text_of(const Program& program, NodeId id, int depth) {
  const Node& node = program.nodes[id];
  if (depth > kDeepest) return {};
  if (node.op == Op::kNumberPi) return "pi";
  if (node.op == Op::kConstant) return rational_text(program.constants[node.index]);
  const std::string a = operand_text(program, node.a, depth);
  if (a.empty() || a.size() > kLongest) return {};
  if (node.op == Op::kNegate) return "-" + a;
  if (node.op == Op::kPower) return a + "^" + std::to_string(node.index);
  if (operand_count(node.op) == 1) return std::string(op_name(node.op)) + "(" + a + ")";
  const std::string b = operand_text(program, node.b, depth);
  if (b.empty()) return {};
  if (node.op == Op::kAtan2) return "atan2(" + a + ", " + b + ")";
  return a + sign_of(node.op) + b;
}

}  // namespace

std::string constant_text(const Program& program, NodeId id) {
  const std::string text = text_of(program, id, 0);
  return text.size() > kLongest ? std::string() : text;
}

}  // namespace regulus::detail
