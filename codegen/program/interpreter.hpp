// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a program over any kind of number. An Arithmetic is a class with
//
//   using Number = …;
//   Number constant(const cln::cl_RA&), pi();
//   Number negate(Number), add, subtract, multiply, divide, atan2(Number, Number);
//   Number power(Number, unsigned exponent ≥ 2), call(Op, Number);
//
// What happens outside a domain is the arithmetic's business: a flag, or an exception.
#pragma once

#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "regulus/codegen/program/program.hpp"

namespace regulus::codegen {

/// The values of some nodes, by NodeId, known without running the program.
template <class Number>
using KnownValues = std::vector<std::optional<Number>>;

/// The rational constants and π, converted once.
template <class Arithmetic>
[[nodiscard]] KnownValues<typename Arithmetic::Number> convert_constants(const Program& program,
                                                                         Arithmetic& arithmetic) {
  KnownValues<typename Arithmetic::Number> known(program.nodes.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Node& node = program.nodes[i];
    if (node.op == Op::kConstant) known[i] = arithmetic.constant(program.constants[node.index]);
    if (node.op == Op::kPi) known[i] = arithmetic.pi();
  }
  return known;
}

/// One node from the values of its operands. Not for leaves: they have none.
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
void run(const Program& program, const KnownValues<Number>& known, std::span<const Number> inputs,
         std::span<const Number> points, std::span<Number> values, Arithmetic& arithmetic) {
  for (std::size_t i = 0; i < program.nodes.size(); ++i) {
    const Node& node = program.nodes[i];
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

/// The outputs of the program at `inputs` and `points`.
///
/// Requires  as many inputs and points as the program declares; std::invalid_argument otherwise.
template <class Arithmetic, class Number = typename Arithmetic::Number>
[[nodiscard]] std::vector<Number> evaluate(const Program& program, std::span<const Number> inputs,
                                           std::span<const Number> points, Arithmetic& arithmetic) {
  if (inputs.size() != program.inputs.size() || points.size() != program.points.size())
    throw std::invalid_argument("the program declares another number of inputs or points");
  const auto known = convert_constants(program, arithmetic);
  std::vector<Number> values(program.nodes.size());
  run<Arithmetic, Number>(program, known, inputs, points, values, arithmetic);
  std::vector<Number> outputs;
  outputs.reserve(program.outputs.size());
  for (const NodeId output : program.outputs) outputs.push_back(values[output]);
  return outputs;
}

}  // namespace regulus::codegen
