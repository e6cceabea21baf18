// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/gcode.hpp"

namespace regulus::verifier {

NodeId angle_of(Graph& graph, const Rational& y, const Rational& x) {
  const Rational turns = Rational(y.sign()) / Rational(x.is_zero() ? 2 : 1);
  const NodeId part_of_turn = graph.add(Op::kMultiply, graph.number(turns), graph.add(Op::kPi));
  if (x.is_zero()) return part_of_turn;
  const NodeId angle = graph.add(Op::kAtan, graph.number(y / x));
  return x.sign() > 0 ? angle : graph.add(Op::kAdd, angle, part_of_turn);
}

}  // namespace regulus::verifier
