// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/derivative.hpp"

#include <stdexcept>

#include "runtime/verifier/evaluation.hpp"

namespace regulus::verifier {

NodeId Differentiator::of(NodeId id) {
  if (const auto known = known_.find(id); known != known_.end()) return known->second;
  const NodeId result = differentiate(graph_.nodes()[std::size_t(id)], id);
  known_.emplace(id, result);
  return result;
}

NodeId Differentiator::product(NodeId a, NodeId b) {
  if (a == kNoNode || b == kNoNode) return kNoNode;
  if (a == one_) return b;
  return b == one_ ? a : graph_.add(Op::kMultiply, a, b);
}

NodeId Differentiator::sum(NodeId a, NodeId b) {
  if (a == kNoNode) return b;
  return b == kNoNode ? a : graph_.add(Op::kAdd, a, b);
}

NodeId Differentiator::negative(NodeId a) {
  return a == kNoNode ? kNoNode : graph_.add(Op::kNegate, a);
}

NodeId Differentiator::quotient(NodeId a, NodeId b) {
  return a == kNoNode ? kNoNode : graph_.add(Op::kDivide, a, b);
}

NodeId Differentiator::differentiate(const Node node, NodeId id) {
  if (node.op == Op::kVariable) return node.a == variable_ ? one_ : kNoNode;
  if (operands(node.op) == 0) return kNoNode;
  const NodeId da = of(node.a), db = operands(node.op) > 1 ? of(node.b) : kNoNode;
  if (da == kNoNode && db == kNoNode) return kNoNode;
  switch (node.op) {
    case Op::kNegate:
      return negative(da);
    case Op::kAdd:
      return sum(da, db);
    case Op::kSubtract:
      return sum(da, negative(db));
    case Op::kMultiply:
      return sum(product(da, node.b), product(node.a, db));
    case Op::kDivide:
      return quotient(sum(da, negative(product(id, db))), node.b);
    case Op::kPower:
      return product(product(graph_.number(std::to_string(node.b)), power(node.a, node.b - 1)), da);
    case Op::kAtan2: {
      const NodeId norm = sum(power(node.a, 2), power(node.b, 2));
      return quotient(sum(product(node.b, da), negative(product(node.a, db))), norm);
    }
    default:
      return product(slope(node, id), da);
  }
}

/// Returns f′(a), given the node of f(a).
NodeId Differentiator::slope(const Node& node, NodeId id) {
  const NodeId a = node.a;
  switch (node.op) {
    case Op::kSqrt:
      return quotient(one_, sum(id, id));
    case Op::kSin:
      return graph_.add(Op::kCos, a);
    case Op::kCos:
      return negative(graph_.add(Op::kSin, a));
    case Op::kTan:
      return sum(one_, power(id, 2));
    case Op::kAsin:
    case Op::kAcos: {
      const NodeId root = graph_.add(Op::kSqrt, graph_.add(Op::kSubtract, one_, power(a, 2)));
      return node.op == Op::kAsin ? quotient(one_, root) : negative(quotient(one_, root));
    }
    case Op::kAtan:
      return quotient(one_, sum(one_, power(a, 2)));
    case Op::kExp:
      return id;
    case Op::kLog:
      return quotient(one_, a);
    case Op::kAbs:
      return graph_.add(Op::kSign, a);
    case Op::kSign:
      // The derivative of a sign is 0, but it is undefined where the sign jumps.
      return product(graph_.number("0"), quotient(one_, a));
    default:
      throw std::logic_error("not a function of one argument");
  }
}

std::vector<NodeId> kinks_of(Graph& graph, const std::vector<NodeId>& derivatives) {
  const NodeId one = graph.number("1");
  std::vector<NodeId> result;
  for (const NodeId id : ingredients(graph, derivatives)) {
    const Node node = graph.nodes()[std::size_t(id)];
    if (node.op == Op::kSign) result.push_back(graph.add(Op::kDivide, one, node.a));
  }
  return result;
}

}  // namespace regulus::verifier
