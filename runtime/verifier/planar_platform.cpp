// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/planar_platform.hpp"

#include "runtime/verifier/middle_angle.hpp"

namespace regulus::verifier {
void form_planar_equations(Question& q) {
  const SolutionLines& claim = *q.solutions;
  Graph& graph = q.graph;
  const auto plus = [&](NodeId a, NodeId b) { return graph.add(Op::kAdd, a, b); };
  const auto minus = [&](NodeId a, NodeId b) { return graph.add(Op::kSubtract, a, b); };
  const auto times = [&](NodeId a, NodeId b) { return graph.add(Op::kMultiply, a, b); };
  const auto squares = [&](NodeId a, NodeId b) { return plus(times(a, a), times(b, b)); };
  const auto root = [&](NodeId a) { return graph.add(Op::kSqrt, a); };
  const NodeId x = graph.add(Op::kVariable, 0), y = graph.add(Op::kVariable, 1),
               phi = graph.add(Op::kVariable, 2), c = graph.add(Op::kCos, phi),
               s = graph.add(Op::kSin, phi);
  ClosureLines closure;
  closure.names = {"x", "y", "phi"};
  for (const LegLine& leg : claim.legs) {
    const auto& [a, b] = std::pair(leg.base, leg.platform);
    const NodeId u = plus(x, minus(times(c, b[0]), times(s, b[1]))),
                 v = plus(y, plus(times(s, b[0]), times(c, b[1])));
    closure.equations.push_back(minus(squares(minus(u, a[0]), minus(v, a[1])), leg.square));
  }
  // |p − a| ≤ ρ + |b| for the first leg; more, so that no solution is at an end.
  NodeId reach = graph.number("0");
  for (const LegLine& leg : claim.legs)
    reach = plus(reach, plus(root(leg.square), root(squares(leg.platform[0], leg.platform[1]))));
  reach = times(graph.number("2"), reach);
  const LegLine& first = claim.legs.front();
  closure.middle = {first.base[0], first.base[1], middle_angle(claim.solutions, 2, graph)};
  closure.radius = {reach, reach, graph.add(Op::kPi)};
  q.closure = std::move(closure);
  q.alpha = graph.number("0");
}

}  // namespace regulus::verifier
