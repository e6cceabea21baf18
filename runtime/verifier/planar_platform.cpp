// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/planar_platform.hpp"

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/middle_angle.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/variety.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfBase = 128;

}  // namespace

void form_planar_equations(Question& q) {
  const SolutionLines& claim = *q.solutions;
  Graph& graph = q.graph;
  const auto plus = [&](NodeId a, NodeId b) { return graph.add(Op::kAdd, a, b); };
  const auto minus = [&](NodeId a, NodeId b) { return graph.add(Op::kSubtract, a, b); };
  const auto times = [&](NodeId a, NodeId b) { return graph.add(Op::kMultiply, a, b); };
  const auto squares = [&](NodeId a, NodeId b) { return plus(times(a, a), times(b, b)); };
  const auto root = [&](NodeId a) { return graph.add(Op::kSqrt, a); };
  const auto unknown = [&](std::size_t number) {
    return graph.add(Op::kVariable, int(q.variables.size() + number));
  };
  const NodeId x = unknown(0), y = unknown(1), phi = unknown(2), c = graph.add(Op::kCos, phi),
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
  q.alpha = graph.number("0");
  std::vector<Ball> places;
  for (const Interval place : enclose_variety(q).outer) places.emplace_back(place, kBitsOfBase);
  const LegLine& first = claim.legs.front();
  const auto values = evaluate(graph, {reach, first.base[0], first.base[1]}, places, kBitsOfBase);
  if (!values) throw Unfinished("a number of the legs has no certain value");
  const Interval most = (*values)[0].enclosure(), a = (*values)[1].enclosure(),
                 b = (*values)[2].enclosure();
  const Interval radius = 2.0 * most + (a - point(mid(a))) + (b - point(mid(b)));
  if (!is_bounded(radius)) throw Unfinished("a number of the legs is too large");
  const auto number = [&](double value) { return graph.number(rational_of(value)); };
  closure.middle = {number(mid(a)), number(mid(b)), middle_angle(claim.solutions, 2, graph)};
  closure.radius = {number(radius.hi), number(radius.hi), graph.add(Op::kPi)};
  q.closure = std::move(closure);
}

}  // namespace regulus::verifier
