// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/ball_program.hpp"

#include <algorithm>
#include <stdexcept>

#include "codegen/kernel/program/arb_arithmetic.hpp"
#include "codegen/kernel/program/run.hpp"

namespace regulus::detail {
namespace {

bool is_consistent(const BallProgram& program, NodeId at) noexcept {
  const Node& node = program.nodes[at];
  const int operands = node.op <= Op::kAbs ? operand_count(node.op) : -1;
  if (operands < 0 || (operands > 0 && node.a >= at) || (operands > 1 && node.b >= at))
    return false;
  switch (node.op) {
    case Op::kConstant:
      return node.index < program.constants.size();
    case Op::kInput:
      return node.index < program.inputs;
    case Op::kPoint:
      return false;
    default:
      return true;
  }
}

KnownValues<Ball> known_values(const BallProgram& program, const ArbArithmetic& arithmetic,
                               long bits) {
  KnownValues<Ball> known(program.nodes.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Node& node = program.nodes[i];
    if (node.op == Op::kConstant) known[i] = Ball(program.constants[node.index], bits);
    if (node.op == Op::kNumberPi) known[i] = arithmetic.pi();
  }
  return known;
}

}  // namespace

bool is_consistent(const BallProgram& program) noexcept {
  for (std::size_t i = 0; i < program.nodes.size(); ++i)
    if (!is_consistent(program, static_cast<NodeId>(i))) return false;
  return std::ranges::all_of(program.outputs,
                             [&](NodeId output) { return output < program.nodes.size(); });
}

std::optional<std::vector<Ball>> evaluate(const BallProgram& program, std::span<const Ball> inputs,
                                          long bits) {
  if (inputs.size() != program.inputs)
    throw std::invalid_argument("the program declares another number of inputs");
  ArbArithmetic arithmetic(bits);
  const KnownValues<Ball> known = known_values(program, arithmetic, bits);
  std::vector<Ball> values(program.nodes.size());
  run<ArbArithmetic, Ball>(std::span<const Node>(program.nodes), known, inputs, {}, values,
                           arithmetic);
  if (arithmetic.undefined()) return std::nullopt;
  std::vector<Ball> outputs;
  outputs.reserve(program.outputs.size());
  for (const NodeId output : program.outputs) outputs.push_back(values[output]);
  return outputs;
}

}  // namespace regulus::detail
