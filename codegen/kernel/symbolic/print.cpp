// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/print.hpp"

#include <cln/rational_io.h>

#include <sstream>

#include "codegen/support/infix_text.hpp"

namespace regulus::detail {
namespace {

using enum Precedence;

/// `context`: the precedence of the operation around the text.
std::string print(const Expression& e, Precedence context);

std::string parenthesized(const std::string& text, bool needed) {
  return needed ? in_parentheses(text) : text;
}

std::string print_constant(const cln::cl_RA& value, Precedence context) {
  std::ostringstream text;
  text << value;
  const bool fraction = text.str().find('/') != std::string::npos;
  const bool tight = context == kPower || (context == kProduct && fraction);
  return parenthesized(text.str(), (minusp(value) && context != kSum) || tight);
}

std::string print_call(const Expression& e) {
  std::string text = name_of(e.function());
  const char* separator = "(";
  for (const Expression& argument : e.operands()) {
    text.append(separator).append(print(argument, kSum));
    separator = ", ";
  }
  return text + ")";
}

std::string print_power(const Expression& base, int exponent) {
  if (exponent == 1) return print(base, kPower);
  return print(base, kPower) + "^" + std::to_string(exponent);
}

bool divides(const Expression& factor) {
  return factor.kind() == ExpressionKind::kPower && factor.exponent() < 0;
}

void append_factor(std::string& text, const std::string& factor) {
  if (!text.empty()) text.append("*");
  text.append(factor);
}

std::string print_product(const Expressions& factors, Precedence context) {
  const bool minus = factors[0].is_constant(-1);
  std::string numerator, denominator;
  int denominators = 0;
  for (std::size_t i = minus ? 1 : 0; i < factors.size(); ++i) {
    const Expression& factor = factors[i];
    if (i == 0 && factor.kind() == ExpressionKind::kConstant) {
      numerator = print_constant(factor.value(), kSum);
    } else if (divides(factor)) {
      append_factor(denominator, print_power(factor.operands()[0], -factor.exponent()));
      ++denominators;
    } else {
      append_factor(numerator, print(factor, kProduct));
    }
  }
  if (numerator.empty()) numerator.push_back('1');
  if (denominators > 0) numerator.append("/").append(parenthesized(denominator, denominators > 1));
  const std::string text = std::string(minus ? "-" : "").append(numerator);
  const bool leading_minus = text.front() == '-';
  return parenthesized(text, context == kPower || (context == kProduct && leading_minus));
}

std::string print_sum(const Expressions& terms, Precedence context) {
  std::string text;
  for (const Expression& term : terms) {
    const bool subtracted = !text.empty() && minusp(coefficient_of(term));
    const Expression shown = subtracted ? divide_by(term, -1) : term;
    if (!text.empty()) text.append(subtracted ? " - " : " + ");
    text.append(print(shown, shown.kind() == ExpressionKind::kSum ? kProduct : kSum));
  }
  return parenthesized(text, context != kSum);
}

std::string print(const Expression& e, Precedence context) {
  switch (e.kind()) {
    case ExpressionKind::kConstant:
      return print_constant(e.value(), context);
    case ExpressionKind::kNumberPi:
      return "pi";
    case ExpressionKind::kPoint:
    case ExpressionKind::kVariable:
      return e.name();
    case ExpressionKind::kPower:
      if (e.exponent() < 0) return print_product({e}, context);
      return parenthesized(print_power(e.operands()[0], e.exponent()), context == kPower);
    case ExpressionKind::kCall:
      return print_call(e);
    case ExpressionKind::kProduct:
      return print_product(e.operands(), context);
    case ExpressionKind::kSum:
      return print_sum(e.operands(), context);
  }
  return {};
}

}  // namespace

std::string to_string(const Expression& expression) { return print(expression, kSum); }

}  // namespace regulus::detail
