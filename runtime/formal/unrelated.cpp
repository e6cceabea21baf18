// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/unrelated.hpp"

#include <algorithm>
#include <utility>

#include "runtime/verifier/evaluation.hpp"

namespace regulus::verifier {

bool has_variables(const Graph& graph, NodeId node) {
  return std::ranges::any_of(ingredients(graph, {node}), [&graph](NodeId id) {
    return graph.nodes()[std::size_t(id)].op == Op::kVariable;
  });
}

namespace {

/// Returns true for a multiple of pi/parts, as far as 128 bits tell.
bool is_multiple_of_part(Graph& graph, NodeId angle, const char* parts) {
  constexpr long kBits = 128;
  const NodeId product = graph.add(Op::kMultiply, graph.number(parts), angle);
  const auto value =
      evaluate(graph, {graph.add(Op::kDivide, product, graph.add(Op::kPi))}, {}, kBits);
  return value && arb_contains_int(value->front().get()) != 0;
}

}  // namespace

bool is_known_angle(Graph& graph, NodeId angle) {
  return !has_variables(graph, angle) &&
         (is_multiple_of_part(graph, angle, "6") || is_multiple_of_part(graph, angle, "4"));
}

NodeId Unrelated::of(NodeId node) {
  const auto known = known_.find(node);
  if (known != known_.end()) return known->second;
  std::map<NodeId, NodeId> functions;
  for (const NodeId id : ingredients(graph_, {node})) {
    const Node function = graph_.nodes()[std::size_t(id)];
    if ((function.op == Op::kCos || function.op == Op::kSin) && has_variables(graph_, function.a))
      functions[id] = graph_.add(Op::kMultiply, id, even_factor(function));
  }
  return known_[node] = replaced(graph_, node, std::move(functions));
}

/// Close to 1, so that roots keep their values.
NodeId Unrelated::even_factor(const Node& function) {
  const NodeId square = graph_.add(Op::kPower, function.a, 2);
  const NodeId part = graph_.number(function.op == Op::kCos ? "3e-7" : "7e-7");
  return graph_.add(Op::kAdd, graph_.number("1"), graph_.add(Op::kMultiply, part, square));
}

}  // namespace regulus::verifier
