// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/expression.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

namespace regulus::detail {

namespace {

void mix(std::size_t& seed, std::size_t value) {
  seed ^= value + 0x9e3779b97f4a7c15ULL + (seed << 6) + (seed >> 2);
}

bool can_be_undefined(Call function, const Expressions& arguments) {
  switch (function) {
    case Call::kSqrt:
      return arguments[0].kind() != ExpressionKind::kConstant || minusp(arguments[0].value());
    case Call::kTan:
    case Call::kAsin:
    case Call::kAcos:
    case Call::kAtan2:
    case Call::kLog:
      return true;
    default:
      return false;
  }
}

}  // namespace

/// Shares nodes whose flags and hash follow from their content.
struct ExpressionFactory {
  using Node = Expression::Node;

  static std::unique_ptr<Node> node(ExpressionKind kind) {
    auto result = std::make_unique<Node>();
    result->kind = kind;
    return result;
  }
  static Expression complete(std::unique_ptr<Node> node) {
    std::size_t hash = static_cast<std::size_t>(node->kind);
    mix(hash, static_cast<std::size_t>(node->function));
    mix(hash, static_cast<std::size_t>(node->exponent));
    if (node->kind == ExpressionKind::kConstant) mix(hash, cln::equal_hashcode(node->value));
    if (!node->name.empty()) mix(hash, std::hash<std::string>()(node->name));
    node->has_variables = node->kind == ExpressionKind::kVariable;
    for (const Expression& operand : node->operands) {
      mix(hash, operand.hash());
      node->has_variables = node->has_variables || operand.has_variables();
      node->is_total = node->is_total && operand.is_total();
    }
    if (node->kind == ExpressionKind::kPower && node->exponent < 0) node->is_total = false;
    if (node->kind == ExpressionKind::kCall && can_be_undefined(node->function, node->operands))
      node->is_total = false;
    node->hash = hash;
    return Expression(std::move(node));
  }
  static Expression compound(ExpressionKind kind, Expressions operands) {
    auto result = node(kind);
    result->operands = std::move(operands);
    return complete(std::move(result));
  }
  static Expression symbol(ExpressionKind kind, const std::string& name) {
    auto result = node(kind);
    result->name = name;
    return complete(std::move(result));
  }
  static Expression constant(const cln::cl_RA& value) {
    auto result = node(ExpressionKind::kConstant);
    result->value = value;
    return complete(std::move(result));
  }
  static Expression power(const Expression& base, int exponent) {
    auto result = node(ExpressionKind::kPower);
    result->exponent = exponent;
    result->operands = {base};
    return complete(std::move(result));
  }
  static Expression call(Call function, Expressions arguments) {
    auto result = node(ExpressionKind::kCall);
    result->function = function;
    result->operands = std::move(arguments);
    return complete(std::move(result));
  }
};

const char* name_of(Call function) noexcept {
  static constexpr std::array<const char*, 11> kNames = {
      "sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "log", "abs"};
  return kNames[static_cast<std::size_t>(function)];
}

Expression::Expression(const cln::cl_RA& value) : Expression(ExpressionFactory::constant(value)) {}

bool Expression::is_constant(int value) const {
  return kind() == ExpressionKind::kConstant && node_->value == value;
}

Expression pi() { return ExpressionFactory::symbol(ExpressionKind::kNumberPi, ""); }
Expression variable(const std::string& name) {
  return ExpressionFactory::symbol(ExpressionKind::kVariable, name);
}
Expression point(const std::string& name) {
  return ExpressionFactory::symbol(ExpressionKind::kPoint, name);
}

namespace {

void sort_canonically(Expressions& operands) {
  std::sort(operands.begin(), operands.end(),
            [](const Expression& a, const Expression& b) { return compare(a, b) < 0; });
}

/// Returns the operands, with nested ones of the same kind merged in; constants go through `fold`.
template <class Fold>
Expressions flatten(ExpressionKind kind, Expressions operands, Fold fold) {
  Expressions flat;
  flat.reserve(operands.size());
  const auto take = [&](auto&& e) {
    if (e.kind() == ExpressionKind::kConstant)
      fold(e.value());
    else
      flat.push_back(std::forward<decltype(e)>(e));
  };
  for (Expression& operand : operands) {
    if (operand.kind() == kind)
      for (const Expression& inner : operand.operands()) take(inner);
    else
      take(std::move(operand));
  }
  return flat;
}

}  // namespace

Expression sum(Expressions terms) {
  cln::cl_RA constant = 0;
  Expressions flat = flatten(ExpressionKind::kSum, std::move(terms),
                             [&](const cln::cl_RA& c) { constant = constant + c; });
  if (flat.empty()) return Expression(constant);
  sort_canonically(flat);
  if (!zerop(constant)) flat.push_back(Expression(constant));
  return flat.size() == 1 ? flat[0]
                          : ExpressionFactory::compound(ExpressionKind::kSum, std::move(flat));
}

Expression product(Expressions factors) {
  cln::cl_RA constant = 1;
  Expressions flat = flatten(ExpressionKind::kProduct, std::move(factors),
                             [&](const cln::cl_RA& c) { constant = constant * c; });
  if (zerop(constant)) {
    std::erase_if(flat, [](const Expression& e) { return e.is_total(); });
  }
  if (flat.empty()) return Expression(constant);
  sort_canonically(flat);
  if (constant != 1) flat.insert(flat.begin(), Expression(constant));
  return flat.size() == 1 ? flat[0]
                          : ExpressionFactory::compound(ExpressionKind::kProduct, std::move(flat));
}

Expression product(Expression a, Expression b) {
  Expressions factors;
  factors.reserve(2);
  factors.push_back(std::move(a));
  factors.push_back(std::move(b));
  return product(std::move(factors));
}

Expression power(const Expression& base, int exponent) {
  if (exponent == 1) return base;
  // f^0 is 1 where f is defined.
  if (exponent == 0) return sum({Expression(1), product({Expression(0), base})});
  if (base.kind() == ExpressionKind::kConstant && !(exponent < 0 && zerop(base.value())))
    return Expression(cln::expt(base.value(), exponent));
  // (f^-1)^-1 is f only where f ≠ 0: two negative exponents stay.
  if (base.kind() == ExpressionKind::kPower && !(base.exponent() < 0 && exponent < 0))
    return power(base.operands()[0], base.exponent() * exponent);
  return ExpressionFactory::power(base, exponent);
}

Expression call(Call function, Expressions arguments) {
  const bool zero = arguments[0].is_constant(0);
  if (zero && (function == Call::kSin || function == Call::kTan || function == Call::kAtan ||
               function == Call::kAsin || function == Call::kSqrt || function == Call::kAbs))
    return Expression(0);
  if (zero && (function == Call::kCos || function == Call::kExp)) return Expression(1);
  return ExpressionFactory::call(function, std::move(arguments));
}

Expression operator+(const Expression& a, const Expression& b) { return sum({a, b}); }
Expression operator-(const Expression& a) { return product(Expression(-1), a); }
Expression operator-(const Expression& a, const Expression& b) { return sum({a, -b}); }
Expression operator*(const Expression& a, const Expression& b) { return product(a, b); }

cln::cl_RA coefficient_of(const Expression& term) {
  if (term.kind() == ExpressionKind::kConstant) return term.value();
  if (term.kind() == ExpressionKind::kProduct &&
      term.operands()[0].kind() == ExpressionKind::kConstant)
    return term.operands()[0].value();
  return 1;
}

Expression divide_by(const Expression& e, const cln::cl_RA& c) {
  const Expression inverse(cln::recip(c));
  if (e.kind() != ExpressionKind::kSum) return product({inverse, e});
  Expressions terms;
  for (const Expression& term : e.operands()) terms.push_back(product({inverse, term}));
  return sum(std::move(terms));
}

Signed normalize_sign(const Expression& e) {
  // The sign of the first term decides, in an order of the terms that ignores signs.
  const Expression* lead = &e;
  if (e.kind() == ExpressionKind::kSum) {
    const auto bare = [](const Expression& t) {
      const cln::cl_RA c = coefficient_of(t);
      return zerop(c) ? t : divide_by(t, c);
    };
    for (const Expression& term : e.operands())
      if (lead == &e || compare(bare(term), bare(*lead)) < 0) lead = &term;
  }
  if (!minusp(coefficient_of(*lead))) return {1, e};
  return {-1, divide_by(e, -1)};
}

}  // namespace regulus::detail
