// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/expression_text.hpp"

#include <utility>

namespace regulus::detail {
namespace {

/// Returns the right operand of a binary operator. It puts a sign in parentheses for readability.
/// It also puts an operator of the same precedence in parentheses, because C++ would group to the
/// left.
std::string right_of(const ExpressionText& b, Precedence precedence) {
  const bool plain = b.precedence > precedence && b.precedence != Precedence::kSign;
  return plain ? b.text : in_parentheses(b.text);
}

ExpressionText binary(const ExpressionText& a, const char* sign, const ExpressionText& b,
                      Precedence precedence) {
  return {concatenate({a.at_least(precedence), sign, right_of(b, precedence)}), precedence};
}

}  // namespace

std::string concatenate(std::initializer_list<std::string_view> pieces) {
  std::string result;
  for (const std::string_view piece : pieces) result += piece;
  return result;
}

ExpressionText atom(std::string text) { return {std::move(text), Precedence::kPrimary}; }

ExpressionText negation(const ExpressionText& a) {
  return {concatenate({"-", a.at_least(Precedence::kPrimary)}), Precedence::kSign};
}

ExpressionText sum(const ExpressionText& a, const ExpressionText& b) {
  return binary(a, " + ", b, Precedence::kSum);
}

ExpressionText difference(const ExpressionText& a, const ExpressionText& b) {
  return binary(a, " - ", b, Precedence::kSum);
}

ExpressionText product(const ExpressionText& a, const ExpressionText& b) {
  return binary(a, " * ", b, Precedence::kProduct);
}

}  // namespace regulus::detail
