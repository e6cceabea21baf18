// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/verifier/quantity_lines.hpp"

namespace regulus::verifier {

/// Sums and products without zeros and ones, which would make the proof longer.
class ShortTerms {
 public:
  explicit ShortTerms(Graph& graph)
      : graph_(graph), zero(graph.number("0")), one(graph.number("1")) {}

  [[nodiscard]] NodeId sum(NodeId x, NodeId y) const {
    if (is_zero(x) || is_zero(y)) return is_zero(x) ? y : x;
    return graph_.add(Op::kAdd, x, y);
  }
  [[nodiscard]] NodeId difference(NodeId x, NodeId y) const {
    if (is_zero(y)) return x;
    return is_zero(x) ? graph_.add(Op::kNegate, y) : graph_.add(Op::kSubtract, x, y);
  }
  [[nodiscard]] NodeId product(NodeId x, NodeId y) const {
    if (is_zero(x) || is_zero(y)) return zero;
    if (x == one || y == one) return x == one ? y : x;
    return graph_.add(Op::kMultiply, x, y);
  }
  [[nodiscard]] NodeId quotient(NodeId x, NodeId y) const {
    return is_zero(x) ? zero : product(x, reciprocal(y));
  }
  /// Returns 1/x. Requires, as do square() and its callers: x and 1/x must have values for other
  /// reasons, because a/(b/c) = ac/b and √x² = x have them elsewhere, too.
  [[nodiscard]] NodeId reciprocal(NodeId x) const {
    const Node node = graph_.nodes()[std::size_t(x)];
    if (node.op == Op::kDivide) return product(node.b, reciprocal(node.a));
    if (node.op == Op::kMultiply) return product(reciprocal(node.a), reciprocal(node.b));
    return x == one ? one : graph_.add(Op::kDivide, one, x);
  }
  [[nodiscard]] NodeId square(NodeId x) const {
    const Node node = graph_.nodes()[std::size_t(x)];
    if (is_zero(x) || x == one) return x;
    if (node.op == Op::kSqrt) return node.a;
    if (node.op == Op::kMultiply) return product(square(node.a), square(node.b));
    if (node.op == Op::kDivide) return product(square(node.a), reciprocal(square(node.b)));
    return graph_.add(Op::kPower, x, 2);
  }
  [[nodiscard]] NodeId signed_by(int sign, NodeId x) const {
    return sign > 0 || is_zero(x) ? x : graph_.add(Op::kNegate, x);
  }
  [[nodiscard]] NodeId add(Op op, NodeId x) const { return graph_.add(op, x); }
  [[nodiscard]] bool is_zero(NodeId x) const { return is_zero_number(graph_, x); }

  /// Returns true only if the value is positive wherever it and its reciprocal are defined.
  [[nodiscard]] bool is_positive(NodeId x) const {
    const Node node = graph_.nodes()[std::size_t(x)];
    switch (node.op) {
      case Op::kConstant:
        return graph_.rational(node.a).sign() > 0;
      case Op::kSqrt:
      case Op::kExp:
      case Op::kAbs:
        return true;
      case Op::kDivide:
      case Op::kMultiply:
        return is_positive(node.a) && is_positive(node.b);
      default:
        return false;
    }
  }

 private:
  Graph& graph_;

 public:
  const NodeId zero, one;
};

}  // namespace regulus::verifier
