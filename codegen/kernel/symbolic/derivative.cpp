// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/derivative.hpp"

#include <stdexcept>
#include <vector>

namespace regulus::detail {
namespace {

/// The derivative of a function of one argument with respect to it.
Expression outer_derivative(Call function, const Expression& u) {
  switch (function) {
    case Call::kSqrt:
      return product({Expression(cln::cl_RA(1) / 2), power(call(Call::kSqrt, {u}), -1)});
    case Call::kSin:
      return call(Call::kCos, {u});
    case Call::kCos:
      return -call(Call::kSin, {u});
    case Call::kTan:
      return Expression(1) + power(call(Call::kTan, {u}), 2);
    case Call::kAsin:
      return power(call(Call::kSqrt, {Expression(1) - power(u, 2)}), -1);
    case Call::kAcos:
      return -power(call(Call::kSqrt, {Expression(1) - power(u, 2)}), -1);
    case Call::kAtan:
      return power(Expression(1) + power(u, 2), -1);
    case Call::kExp:
      return call(Call::kExp, {u});
    case Call::kLog:
      return power(u, -1);
    case Call::kAbs:  // the sign
      return u * power(call(Call::kAbs, {u}), -1);
    case Call::kAtan2:
      break;
  }
  throw std::logic_error("not a function of one argument");
}

}  // namespace

Expression Differentiator::derivative(const Expression& e) {
  if (!e.has_variables()) return Expression(0);
  if (const auto found = known_.find(e); found != known_.end()) return found->second;
  Expression result = computed(e);
  known_.emplace(e, result);
  return result;
}

Expression Differentiator::computed(const Expression& e) {
  switch (e.kind()) {
    case ExpressionKind::kVariable:
      if (e.name() == variable_) return Expression(1);
      return symbols_ == nullptr ? Expression(0) : symbols_->derivative(e.name(), variable_);
    case ExpressionKind::kPower: {
      const Expression& base = e.operands()[0];
      const Expression inner = derivative(base);
      if (inner.is_constant(0)) return inner;
      return product({Expression(e.exponent()), power(base, e.exponent() - 1), inner});
    }
    case ExpressionKind::kProduct:
      return of_product(e.operands());
    case ExpressionKind::kSum: {
      Expressions terms;
      for (const Expression& term : e.operands()) terms.push_back(derivative(term));
      return sum(std::move(terms));
    }
    default:
      return of_call(e);
  }
}

Expression Differentiator::of_product(const Expressions& factors) {
  Expressions terms;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const Expression inner = derivative(factors[i]);
    if (inner.is_constant(0)) continue;
    Expressions changed = factors;
    changed[i] = inner;
    terms.push_back(product(std::move(changed)));
  }
  return sum(std::move(terms));
}

Expression Differentiator::of_call(const Expression& e) {
  const Expression& u = e.operands()[0];
  const Expression inner = derivative(u);
  if (e.function() != Call::kAtan2)
    return inner.is_constant(0) ? inner : outer_derivative(e.function(), u) * inner;
  const Expression& x = e.operands()[1];
  const Expression turning = x * inner - u * derivative(x);
  if (turning.is_constant(0)) return turning;
  return turning * power(power(u, 2) + power(x, 2), -1);
}

Polynomial PolynomialDifferentiator::derivative(const Polynomial& p) {
  atoms_->spend(1 + p.terms().size());
  std::vector<PolynomialTerm> terms;
  for (const PolynomialTerm& term : p.terms()) {
    const AtomProduct& variables = term.monomial.variables;
    for (std::size_t i = 0; i < variables.size();) {
      const Atom atom = variables[i];
      const int exponent = exponent_of(variables, atom);
      AtomProduct others = variables;
      others.erase(i, 1);
      atoms_->spend(of_atom(atom).terms().size());
      for (const PolynomialTerm& inner : of_atom(atom).terms())
        terms.push_back(
            {Monomial{multiply(others, inner.monomial.variables),
                      multiply(term.monomial.coefficients, inner.monomial.coefficients)},
             exponent * term.factor * inner.factor});
      i += static_cast<std::size_t>(exponent);
    }
  }
  return Polynomial(std::move(terms));
}

const Polynomial& PolynomialDifferentiator::of_atom(Atom a) {
  const auto found = known_.find(a);
  if (found != known_.end()) return found->second;
  // A copy: the derivative of a symbol may add atoms, and their list then moves.
  const Expression atom = atoms_->variable_expression(a);
  const Expression derived = differentiator_.derivative(atom);
  std::optional<Polynomial> p = expander_->expand(derived);
  return known_.emplace(a, p ? std::move(*p) : expander_->atom(derived)).first->second;
}

}  // namespace regulus::detail
