// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/evaluation.hpp"

#include <algorithm>

#include "runtime/verifier/elementary.hpp"

namespace regulus::verifier {
namespace {

Interval compute(const Node& node, const std::vector<Interval>& values) {
  const Interval a = values[std::size_t(node.a)];
  switch (node.op) {
    case Op::kNegate:
      return -a;
    case Op::kAdd:
      return a + values[std::size_t(node.b)];
    case Op::kSubtract:
      return a - values[std::size_t(node.b)];
    case Op::kMultiply:
      return node.a == node.b ? square(a) : a * values[std::size_t(node.b)];
    case Op::kDivide:
      return a / values[std::size_t(node.b)];
    case Op::kPower:
      return power(a, node.b);
    case Op::kAtan2:
      return apply_atan2(a, values[std::size_t(node.b)]);
    case Op::kSign:
      return {a.lo > 0.0 ? 1.0 : -1.0, a.hi < 0.0 ? -1.0 : 1.0};
    default:
      return apply(node.op, a);
  }
}

/// Returns true only if certainly |a| ≤ 1.
bool is_sine(const Ball& a, long bits) {
  Ball beyond;
  arb_abs(beyond.get(), a.get());
  arb_sub_ui(beyond.get(), beyond.get(), 1, bits);
  return arb_is_nonpositive(beyond.get());
}

}  // namespace

bool certain_defined(const Node& node, const std::vector<Ball>& values, long bits) {
  const auto a = [&]() -> const Ball& { return values[std::size_t(node.a)]; };
  const auto b = [&]() -> const Ball& { return values[std::size_t(node.b)]; };
  switch (node.op) {
    case Op::kDivide:
      return !arb_contains_zero(b().get());
    case Op::kSqrt:
      return arb_is_nonnegative(a().get());
    case Op::kLog:
      return arb_is_positive(a().get());
    case Op::kAsin:
    case Op::kAcos:
      return is_sine(a(), bits);
    case Op::kTan: {
      Ball cosine;
      arb_cos(cosine.get(), a().get(), bits);
      return !arb_contains_zero(cosine.get());
    }
    case Op::kAtan2:
      return !arb_contains_zero(a().get()) || arb_is_positive(b().get());
    default:
      return true;
  }
}

void compute(const Node& node, const std::vector<Ball>& values, arb_ptr result, long bits) {
  const auto a = [&] { return values[std::size_t(node.a)].get(); };
  const auto b = [&] { return values[std::size_t(node.b)].get(); };
  switch (node.op) {
    case Op::kNegate:
      return arb_neg(result, a());
    case Op::kAdd:
      return arb_add(result, a(), b(), bits);
    case Op::kSubtract:
      return arb_sub(result, a(), b(), bits);
    case Op::kMultiply:
      return arb_mul(result, a(), b(), bits);
    case Op::kDivide:
      return arb_div(result, a(), b(), bits);
    case Op::kPower:
      return arb_pow_ui(result, a(), ulong(node.b), bits);
    case Op::kAbs:
      return arb_abs(result, a());
    case Op::kSign:
      return arb_sgn(result, a());
    case Op::kAtan2:
      return arb_atan2(result, a(), b(), bits);
    default:
      return function_in_arb(node.op)(result, a(), bits);
  }
}

Dependence::Dependence(const Graph& graph, std::size_t variables)
    : variables_(variables), depends_(graph.nodes().size() * variables) {
  for (std::size_t i = 0; i < graph.nodes().size(); ++i) {
    const Node& node = graph.nodes()[i];
    if (node.op == Op::kVariable) depends_[i * variables + std::size_t(node.a)] = true;
    for (std::size_t k = 0; k < variables; ++k)
      if ((operands(node.op) > 0 && on(node.a, k)) || (operands(node.op) > 1 && on(node.b, k)))
        depends_[i * variables + k] = true;
  }
}

std::vector<NodeId> ingredients(const Graph& graph, const std::vector<NodeId>& roots) {
  std::vector<bool> needed(graph.nodes().size());
  for (const NodeId root : roots)
    if (root != kNoNode) needed[std::size_t(root)] = true;
  for (std::size_t i = needed.size(); i-- > 0;) {
    const Node& node = graph.nodes()[i];
    if (needed[i] && operands(node.op) > 0) needed[std::size_t(node.a)] = true;
    if (needed[i] && operands(node.op) > 1) needed[std::size_t(node.b)] = true;
  }
  std::vector<NodeId> result;
  for (std::size_t i = 0; i < needed.size(); ++i)
    if (needed[i]) result.push_back(NodeId(i));
  return result;
}

NodeId replaced(Graph& graph, NodeId root, std::map<NodeId, NodeId> nodes) {
  for (const NodeId id : ingredients(graph, {root})) {
    if (nodes.contains(id)) continue;
    const Node node = graph.nodes()[std::size_t(id)];
    NodeId result = id;
    if (operands(node.op) == 1) result = graph.add(node.op, nodes.at(node.a), node.b);
    if (operands(node.op) == 2) result = graph.add(node.op, nodes.at(node.a), nodes.at(node.b));
    nodes.emplace(id, result);
  }
  return nodes.at(root);
}

/// Constants are computed here, once; one that has no bounded value is computed again in each run, where
/// it fails.
Evaluation::Evaluation(const Question& question, const std::vector<NodeId>& roots)
    : q_(question), values_(question.graph.nodes().size()) {
  const Graph& graph = question.graph;
  const std::vector<NodeId> all = ingredients(graph, roots);
  std::vector<bool> varies(values_.size()), is_read(values_.size());
  for (const NodeId root : roots)
    if (root != kNoNode) is_read[std::size_t(root)] = true;
  for (const NodeId id : all) {
    const Node& node = graph.nodes()[std::size_t(id)];
    Interval& value = values_[std::size_t(id)];
    if (node.op == Op::kConstant) value = enclose(graph.rational(node.a));
    if (node.op == Op::kPi) value = enclose_pi();
    bool is_variable = node.op == Op::kVariable;
    if (operands(node.op) > 0) is_variable = varies[std::size_t(node.a)];
    if (operands(node.op) > 1) is_variable = is_variable || varies[std::size_t(node.b)];
    if (operands(node.op) > 0 && !is_variable) value = compute(node, values_);
    varies[std::size_t(id)] = is_variable || !is_bounded(value);
    if (!varies[std::size_t(id)]) continue;
    if (operands(node.op) > 0) is_read[std::size_t(node.a)] = true;
    if (operands(node.op) > 1) is_read[std::size_t(node.b)] = true;
  }
  for (const NodeId id : all) {
    const bool is_variable = varies[std::size_t(id)];
    if (is_variable || is_read[std::size_t(id)])
      steps_.push_back({id, is_variable ? graph.nodes()[std::size_t(id)] : Node{Op::kConstant},
                        values_[std::size_t(id)]});
  }
}

/// Computes an operation for which rounding alone may have put an operand outside the domain.
Interval Evaluation::with_exact_operands(const Node& node, const Box& box) {
  if (operands(node.op) == 0) return everything();
  ExactRanges exact(q_.graph, q_.ends, box, values_);
  for (int i = 0; i < operands(node.op); ++i) {
    const NodeId operand = i == 0 ? node.a : node.b;
    Interval& value = values_[std::size_t(operand)];
    const Interval range = exact.of(operand);
    if (!is_bounded(range)) return everything();
    value = {std::max(value.lo, range.lo), std::min(value.hi, range.hi)};
  }
  return compute(node, values_);
}

Interval Evaluation::narrowed(NodeId root, const Box& box) const {
  return ExactRanges(q_.graph, q_.ends, box, values_).of(root);
}

bool Evaluation::run(const Box& box) {
  for (const Step& step : steps_) {
    Interval value = step.node.op == Op::kVariable ? box[std::size_t(step.node.a)]
                     : operands(step.node.op) == 0 ? step.constant
                                                   : compute(step.node, values_);
    if (!is_bounded(value)) value = with_exact_operands(step.node, box);
    if (!is_bounded(value)) return false;
    values_[std::size_t(step.id)] = value;
  }
  return true;
}

std::optional<std::vector<Ball>> evaluate(const Graph& graph, const std::vector<NodeId>& roots,
                                          std::span<const Ball> variables, long bits) {
  std::vector<Ball> values(graph.nodes().size());
  for (const NodeId id : ingredients(graph, roots)) {
    const Node& node = graph.nodes()[std::size_t(id)];
    Ball& value = values[std::size_t(id)];
    if (!certain_defined(node, values, bits)) return std::nullopt;
    if (node.op == Op::kConstant)
      arb_set_fmpq(value.get(), graph.rational(node.a).get(), bits);
    else if (node.op == Op::kPi)
      arb_const_pi(value.get(), bits);
    else if (node.op == Op::kVariable)
      value = variables[std::size_t(node.a)];
    else
      compute(node, values, value.get(), bits);
    if (!arb_is_finite(value.get())) return std::nullopt;
  }
  std::vector<Ball> result;
  for (const NodeId root : roots) result.push_back(values[std::size_t(root)]);
  return result;
}

}  // namespace regulus::verifier
