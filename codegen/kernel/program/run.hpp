// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the steps of a program whose constants are known as numbers. The threads of a search run
// programs only through this header, which does not use CLN (interpreter.hpp defines an
// Arithmetic).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "codegen/kernel/program/node.hpp"

namespace regulus::detail {

/// The values, by NodeId, of the nodes that are known before the program runs.
template <class Number>
using KnownValues = std::vector<std::optional<Number>>;

/// Computes one node from the values of its operands. Leaves have no operands: not for them.
template <class Arithmetic, class Number>
[[nodiscard]] Number apply(const Node& node, std::span<const Number> values,
                           Arithmetic& arithmetic) {
  const Number& a = values[node.a];
  switch (node.op) {
    case Op::kNegate:
      return arithmetic.negate(a);
    case Op::kAdd:
      return arithmetic.add(a, values[node.b]);
    case Op::kSubtract:
      return arithmetic.subtract(a, values[node.b]);
    case Op::kMultiply:
      return arithmetic.multiply(a, values[node.b]);
    case Op::kDivide:
      return arithmetic.divide(a, values[node.b]);
    case Op::kPower:
      return arithmetic.power(a, node.index);
    case Op::kAtan2:
      return arithmetic.atan2(a, values[node.b]);
    default:
      return arithmetic.call(node.op, a);
  }
}

/// Computes every node into `values`.
///
/// Requires  values.size() = known.size() = number of nodes; every constant and π known;
///           inputs and points as many as the program declares.
template <class Arithmetic, class Number = typename Arithmetic::Number>
void run(std::span<const Node> nodes, const KnownValues<Number>& known,
         std::span<const Number> inputs, std::span<const Number> points, std::span<Number> values,
         Arithmetic& arithmetic) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Node& node = nodes[i];
    if (known[i])
      values[i] = *known[i];
    else if (node.op == Op::kInput)
      values[i] = inputs[node.index];
    else if (node.op == Op::kPoint)
      values[i] = points[node.index];
    else
      values[i] = apply<Arithmetic, Number>(node, values, arithmetic);
  }
}

}  // namespace regulus::detail
