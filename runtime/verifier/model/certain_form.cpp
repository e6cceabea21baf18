// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/certain_form.hpp"

#include "runtime/verifier/evaluation.hpp"

namespace regulus::verifier {

bool CertainForm::is_constant(NodeId node) {
  if (const auto known = constant_.find(node); known != constant_.end()) return known->second;
  bool result = true;
  for (const NodeId part : ingredients(graph_, {node}))
    result = result && graph_.nodes()[std::size_t(part)].op != Op::kVariable;
  return constant_.emplace(node, result).first->second;
}

bool CertainForm::has_sign(NodeId node, int sign, bool strict) {
  const std::tuple key(node, sign, strict);
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  const bool result = compute(graph_.nodes()[std::size_t(node)], sign, strict);
  return known_.emplace(key, result).first->second;
}

bool CertainForm::compute(const Node& node, int sign, bool strict) {
  switch (node.op) {
    case Op::kConstant: {
      const int own = graph_.rational(node.a).sign();
      return own == 0 ? !strict : own == sign;
    }
    case Op::kNegate:
      return has_sign(node.a, -sign, strict);
    case Op::kAdd:
    case Op::kSubtract: {
      const int second = node.op == Op::kAdd ? sign : -sign;
      return has_sign(node.a, sign, false) && has_sign(node.b, second, false) &&
             (!strict || has_sign(node.a, sign, true) || has_sign(node.b, second, true));
    }
    case Op::kMultiply:
    case Op::kDivide:
      return has_sign_of_product(node, sign, strict);
    case Op::kPower:
      if (node.b % 2 != 0) return has_sign(node.a, sign, strict);
      return sign > 0 && (!strict || is_nonzero(node.a));
    case Op::kSqrt:
      return sign > 0 && (!strict || has_sign(node.a, 1, true));
    case Op::kAbs:
      return sign > 0 && (!strict || is_nonzero(node.a));
    case Op::kAcos:
      return sign > 0 && !strict;
    case Op::kPi:
    case Op::kExp:
      return sign > 0;
    default:
      return false;
  }
}

/// A divisor is not 0 where the quotient is defined.
bool CertainForm::has_sign_of_product(const Node& node, int sign, bool strict) {
  if (node.a == node.b)
    return sign > 0 && (!strict || node.op == Op::kDivide || is_nonzero(node.a));
  const bool strict_second = strict && node.op == Op::kMultiply;
  for (const int first : {1, -1})
    if (has_sign(node.a, first, strict) && has_sign(node.b, first * sign, strict_second))
      return true;
  return false;
}

}  // namespace regulus::verifier
