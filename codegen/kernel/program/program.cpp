// SPDX-License-Identifier: GPL-3.0-or-later
//
// Folding must not change where an expression is defined: a pose at which a sub-expression has no
// value is "undefined", never safe, even when that sub-expression is multiplied by 0. So a node may
// only disappear when it is total, i.e. certainly defined for all values of inputs and points.
#include "codegen/kernel/program/program.hpp"

#include <cln/integer.h>

#include <limits>
#include <stdexcept>
#include <utility>

#include "codegen/kernel/program/canonical.hpp"
#include "codegen/kernel/program/fold.hpp"

namespace regulus::detail {
namespace {

constexpr std::uint32_t kMaxExponent = 1U << 20;
constexpr NodeId kUnknown = std::numeric_limits<NodeId>::max();

bool commutes(Op op) { return op == Op::kAdd || op == Op::kMultiply; }

}  // namespace

ProgramBuilder::ProgramBuilder(std::vector<std::string> inputs, std::vector<std::string> points) {
  program_.inputs = std::move(inputs);
  program_.points = std::move(points);
}

void ProgramBuilder::require(NodeId id) const {
  if (id >= program_.nodes.size()) throw std::out_of_range("node is not of this builder");
}

bool ProgramBuilder::is_zero(NodeId id) const { return is_constant(id) && cln::zerop(value(id)); }

bool ProgramBuilder::is_total(const Node& node) const {
  for (int k = 0; k < operand_count(node.op); ++k)
    if (!total_[k == 0 ? node.a : node.b]) return false;
  switch (node.op) {
    case Op::kDivide:
      return is_constant(node.b) && !is_zero(node.b);
    case Op::kSqrt:
      return is_constant(node.a) && !cln::minusp(value(node.a));
    case Op::kLog:
      return is_constant(node.a) && cln::plusp(value(node.a));
    case Op::kAsin:
    case Op::kAcos:
      return is_constant(node.a) && cln::abs(value(node.a)) <= 1;
    case Op::kTan:
    case Op::kAtan2:
      return false;
    default:
      return true;
  }
}

std::size_t ProgramBuilder::KeyHash::operator()(const Key& key) const noexcept {
  std::size_t hash = 0;
  for (const std::uint32_t word : key) hash = (hash ^ word) * 0x9e3779b97f4a7c15ULL;
  return hash ^ (hash >> 32);
}

ProgramBuilder::Key ProgramBuilder::key_of(const Node& node) noexcept {
  const bool swap = commutes(node.op) && node.b < node.a;
  return {static_cast<std::uint32_t>(node.op), swap ? node.b : node.a, swap ? node.a : node.b,
          node.index};
}

NodeId ProgramBuilder::intern(Node node) {
  const auto [entry, is_new] =
      known_.try_emplace(key_of(node), static_cast<NodeId>(program_.nodes.size()));
  if (is_new) {
    total_.push_back(is_total(node));
    program_.nodes.push_back(node);
  }
  return entry->second;
}

NodeId ProgramBuilder::constant(const cln::cl_RA& value) {
  const auto next = static_cast<std::uint32_t>(program_.constants.size());
  const auto [entry, is_new] = constant_index_.try_emplace(value, next);
  if (is_new) program_.constants.push_back(value);
  return intern({Op::kConstant, 0, 0, entry->second});
}

NodeId ProgramBuilder::pi() { return intern({Op::kNumberPi}); }

NodeId ProgramBuilder::input(std::uint32_t index) {
  if (index >= program_.inputs.size()) throw std::out_of_range("input is not declared");
  return intern({Op::kInput, 0, 0, index});
}

NodeId ProgramBuilder::point(std::uint32_t index) {
  if (index >= program_.points.size()) throw std::out_of_range("point is not declared");
  return intern({Op::kPoint, 0, 0, index});
}

NodeId ProgramBuilder::zero_where_defined(NodeId a) {
  const NodeId zero = constant(0);
  return total_[a] ? zero : intern({Op::kMultiply, zero, a});
}

NodeId ProgramBuilder::negate(NodeId a) {
  const Node node = at(a);
  if (node.op == Op::kNegate) return node.a;
  if (node.op == Op::kConstant) return constant(-value(a));
  return intern({Op::kNegate, a});
}

NodeId ProgramBuilder::add(NodeId a, NodeId b) {
  if (is_constant(a) && is_constant(b)) return constant(value(a) + value(b));
  if (is_zero(a)) return b;
  if (is_zero(b)) return a;
  if (is_negation(a) && is_negation(b)) return negate(add(at(a).a, at(b).a));
  if (is_negation(b)) return subtract(a, at(b).a);
  if (is_negation(a)) return subtract(b, at(a).a);
  return intern({Op::kAdd, a, b});
}

NodeId ProgramBuilder::subtract(NodeId a, NodeId b) {
  if (is_constant(a) && is_constant(b)) return constant(value(a) - value(b));
  if (a == b) return zero_where_defined(a);
  if (is_zero(a)) return negate(b);
  if (is_zero(b)) return a;
  if (is_negation(b)) return add(a, at(b).a);
  if (is_negation(a)) return negate(add(at(a).a, b));
  const auto reverse = known_.find(key_of({Op::kSubtract, b, a}));
  if (reverse != known_.end()) return intern({Op::kNegate, reverse->second});
  return intern({Op::kSubtract, a, b});
}

/// Returns factor·a; merges the factor with one that a already has.
NodeId ProgramBuilder::scale(const cln::cl_RA& factor, NodeId a) {
  const Node node = at(a);
  if (node.op == Op::kConstant) return constant(factor * value(a));
  if (node.op == Op::kNegate) return scale(-factor, node.a);
  if (node.op == Op::kMultiply && is_constant(node.a)) return scale(factor * value(node.a), node.b);
  if (cln::zerop(factor)) return zero_where_defined(a);
  if (factor == 1) return a;
  if (cln::minusp(factor)) return negate(scale(-factor, a));
  const NodeId constant_factor = constant(factor);
  return intern({Op::kMultiply, constant_factor, a});
}

NodeId ProgramBuilder::multiply(NodeId a, NodeId b) {
  if (is_constant(a)) return scale(cln::cl_RA(value(a)), b);
  if (is_constant(b)) return scale(cln::cl_RA(value(b)), a);
  if (is_negation(a) && is_negation(b)) return multiply(at(a).a, at(b).a);
  if (is_negation(a)) return negate(multiply(at(a).a, b));
  if (is_negation(b)) return negate(multiply(a, at(b).a));
  if (a == b) return power(a, 2);
  return intern({Op::kMultiply, a, b});
}

NodeId ProgramBuilder::divide(NodeId a, NodeId b) {
  if (is_constant(b) && !is_zero(b)) return scale(cln::recip(value(b)), a);
  if (is_negation(a) && is_negation(b)) return divide(at(a).a, at(b).a);
  if (is_negation(a)) return negate(divide(at(a).a, b));
  if (is_negation(b)) return negate(divide(a, at(b).a));
  require(a);
  return intern({Op::kDivide, a, b});
}

NodeId ProgramBuilder::power(NodeId a, int exponent) {
  // Unsigned arithmetic, because −INT_MIN is not an int.
  const auto n = exponent < 0 ? 0U - static_cast<std::uint32_t>(exponent)
                              : static_cast<std::uint32_t>(exponent);
  if (n > kMaxExponent) throw std::out_of_range("exponent is too large");
  if (exponent < 0) return divide(constant(1), power(a, static_cast<int>(n)));
  if (n == 0) return add(zero_where_defined(a), constant(1));
  if (n == 1) return a;
  const Node node = at(a);
  if (node.op == Op::kConstant)
    if (const auto folded = fold_power(value(a), n)) return constant(*folded);
  if (n % 2 == 0 && (node.op == Op::kNegate || node.op == Op::kAbs))
    return power(node.a, static_cast<int>(n));
  if (node.op == Op::kNegate) return negate(power(node.a, static_cast<int>(n)));
  if (node.op == Op::kPower && std::uint64_t{node.index} * n <= kMaxExponent)
    return power(node.a, static_cast<int>(node.index * n));
  return intern({Op::kPower, a, 0, n});
}

NodeId ProgramBuilder::call(Op function, NodeId a) {
  if (function < Op::kSqrt || function > Op::kAbs || function == Op::kAtan2)
    throw std::out_of_range("not a function of one argument");
  const Node node = at(a);
  if (node.op == Op::kConstant)
    if (const auto folded = fold_call(function, value(a))) return constant(*folded);
  if (node.op == Op::kNegate) {
    if (function == Op::kCos || function == Op::kAbs) return call(function, node.a);
    if (function == Op::kSin || function == Op::kTan || function == Op::kAsin ||
        function == Op::kAtan)
      return negate(call(function, node.a));
  }
  if (function == Op::kAbs && (node.op == Op::kAbs || node.op == Op::kSqrt ||
                               (node.op == Op::kPower && node.index % 2 == 0)))
    return a;
  return intern({function, a});
}

NodeId ProgramBuilder::atan2(NodeId a, NodeId b) {
  if (is_zero(a) && is_constant(b) && cln::plusp(value(b))) return a;
  require(b);
  return intern({Op::kAtan2, a, b});
}

NodeId ProgramBuilder::moved(NodeId node, std::uint32_t further) {
  require(node);
  std::vector<NodeId>& known = moved_[further];
  if (known.size() <= node) known.resize(program_.nodes.size(), kUnknown);
  std::vector<NodeId> open = {node};  // no recursion: long sums are deep
  while (!open.empty()) {
    Node copy = at(open.back());
    const std::size_t before = open.size();
    const auto move = [&](NodeId& operand) {
      if (known[operand] != kUnknown)
        operand = known[operand];
      else
        open.push_back(operand);
    };
    const int operands = operand_count(copy.op);
    if (operands > 0) move(copy.a);
    if (operands > 1) move(copy.b);
    if (open.size() > before) continue;
    const NodeId id = open.back();
    open.pop_back();
    known[id] = copy.op == Op::kPoint ? point(copy.index + further) : intern(copy);
  }
  return known[node];
}

void ProgramBuilder::output(NodeId node) {
  require(node);
  program_.outputs.push_back(node);
}

Program ProgramBuilder::finish() && { return canonical(std::move(program_)); }

}  // namespace regulus::detail
