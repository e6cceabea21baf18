// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a program over any kind of number. An Arithmetic is a class with
//
//   using Number = …;
//   Number constant(const cln::cl_RA&), pi();
//   Number negate(Number), add, subtract, multiply, divide, atan2(Number, Number);
//   Number power(Number, unsigned exponent ≥ 2), call(Op, Number);
//
// Each arithmetic decides what happens outside a domain: it sets a flag, or throws an exception.
#pragma once

#include <span>
#include <stdexcept>
#include <vector>

#include "codegen/kernel/program/program.hpp"
#include "codegen/kernel/program/run.hpp"

namespace regulus::detail {

/// The rational constants and π, converted once.
template <class Arithmetic>
[[nodiscard]] KnownValues<typename Arithmetic::Number> convert_constants(const Program& program,
                                                                         Arithmetic& arithmetic) {
  KnownValues<typename Arithmetic::Number> known(program.nodes.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Node& node = program.nodes[i];
    if (node.op == Op::kConstant) known[i] = arithmetic.constant(program.constants[node.index]);
    if (node.op == Op::kNumberPi) known[i] = arithmetic.pi();
  }
  return known;
}

/// The same for a program; converts its constants too.
template <class Arithmetic, class Number = typename Arithmetic::Number>
void run(const Program& program, const KnownValues<Number>& known, std::span<const Number> inputs,
         std::span<const Number> points, std::span<Number> values, Arithmetic& arithmetic) {
  run<Arithmetic, Number>(std::span<const Node>(program.nodes), known, inputs, points, values,
                          arithmetic);
}

/// Returns the outputs of the program at `inputs` and `points`.
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

}  // namespace regulus::detail
