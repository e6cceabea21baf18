// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/canonical.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace regulus::detail {
namespace {

constexpr NodeId kNone = std::numeric_limits<NodeId>::max();

/// Registers that an evaluation of the node as a tree needs: Sethi–Ullman numbers.
std::vector<std::uint32_t> register_needs(const std::vector<Node>& nodes) {
  std::vector<std::uint32_t> need(nodes.size(), 1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Node& node = nodes[i];
    if (operand_count(node.op) == 1) need[i] = need[node.a];
    if (operand_count(node.op) == 2)
      need[i] =
          need[node.a] == need[node.b] ? need[node.a] + 1 : std::max(need[node.a], need[node.b]);
  }
  return need;
}

class Renumbering {
 public:
  explicit Renumbering(Program program)
      : source_(std::move(program)),
        need_(register_needs(source_.nodes)),
        new_id_(source_.nodes.size(), kNone),
        new_constant_(source_.constants.size(), kNone) {}

  Program run() {
    for (const NodeId output : source_.outputs) {
      visit(output);
      result_.outputs.push_back(new_id_[output]);
    }
    result_.inputs = std::move(source_.inputs);
    result_.points = std::move(source_.points);
    return std::move(result_);
  }

 private:
  // Uses an explicit stack, because a sum of thousands of terms is a chain of that depth.
  void visit(NodeId root) {
    std::vector<NodeId> stack{root};
    while (!stack.empty()) {
      const NodeId id = stack.back();
      if (new_id_[id] != kNone || !push_operands(source_.nodes[id], stack)) {
        stack.pop_back();
        if (new_id_[id] == kNone) place(id);
      }
    }
  }

  /// Pushes the operands without a place; the last one pushed is visited first.
  bool push_operands(const Node& node, std::vector<NodeId>& stack) const {
    const int count = operand_count(node.op);
    const std::size_t before = stack.size();
    const bool b_first = count == 2 && need_[node.b] > need_[node.a];
    if (count == 2 && !b_first && new_id_[node.b] == kNone) stack.push_back(node.b);
    if (count >= 1 && new_id_[node.a] == kNone) stack.push_back(node.a);
    if (b_first && new_id_[node.b] == kNone) stack.push_back(node.b);
    return stack.size() > before;
  }

  void place(NodeId id) {
    Node node = source_.nodes[id];
    if (operand_count(node.op) >= 1) node.a = new_id_[node.a];
    if (operand_count(node.op) == 2) node.b = new_id_[node.b];
    if (node.op == Op::kConstant) node.index = place_constant(node.index);
    new_id_[id] = static_cast<NodeId>(result_.nodes.size());
    result_.nodes.push_back(node);
  }

  std::uint32_t place_constant(std::uint32_t index) {
    if (new_constant_[index] == kNone) {
      new_constant_[index] = static_cast<NodeId>(result_.constants.size());
      result_.constants.push_back(source_.constants[index]);
    }
    return new_constant_[index];
  }

  Program source_;
  Program result_;
  std::vector<std::uint32_t> need_;
  std::vector<NodeId> new_id_;
  std::vector<NodeId> new_constant_;
};

}  // namespace

Program canonical(Program program) { return Renumbering(std::move(program)).run(); }

}  // namespace regulus::detail
