// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>

#include "codegen/kernel/symbolic/polynomial.hpp"

namespace regulus::detail {
namespace {

// Higher powers stay atoms, because their expansion would only add occurrences.
constexpr int kLargestExpandedExponent = 8;

/// The square of the root of a rational number.
std::optional<cln::cl_RA> square_of(const Expression& e) {
  if (e.kind() != ExpressionKind::kCall || e.function() != Call::kSqrt) return std::nullopt;
  const Expression& radicand = e.operands()[0];
  if (radicand.kind() != ExpressionKind::kConstant || minusp(radicand.value())) return std::nullopt;
  return radicand.value();
}

}  // namespace

std::optional<Polynomial> Expander::expand(const Expression& e) {
  if (e.kind() == ExpressionKind::kConstant) return Polynomial(e.value());
  if (const auto found = known_.find(e); found != known_.end()) return found->second;
  std::optional<Polynomial> result = expanded(e);
  known_.emplace(e, result);
  return result;
}

Polynomial Expander::atom(const Expression& e) {
  PolynomialTerm term{Monomial{}, 1};
  if (e.has_variables())
    term.monomial.variables = AtomProduct(1, atoms_->variable_atom(e));
  else
    term.monomial.coefficients = AtomProduct(1, atoms_->coefficient_atom(e));
  return Polynomial(std::vector<PolynomialTerm>{std::move(term)});
}

std::optional<Polynomial> Expander::expanded(const Expression& e) {
  switch (e.kind()) {
    case ExpressionKind::kSum:
      return expand_sum(e.operands());
    case ExpressionKind::kProduct:
      return expand_product(e.operands());
    case ExpressionKind::kPower:
      return expand_power(e);
    default:
      return atom(e);
  }
}

std::optional<Polynomial> Expander::expand_sum(const Expressions& terms) {
  std::vector<PolynomialTerm> all;
  for (const Expression& term : terms) {
    const std::optional<Polynomial> p = expand(term);
    if (!p || all.size() + p->terms().size() > most_terms_) return std::nullopt;
    atoms_->spend(1 + p->terms().size());
    all.insert(all.end(), p->terms().begin(), p->terms().end());
  }
  return Polynomial(std::move(all));
}

std::optional<Polynomial> Expander::bounded_product(const Polynomial& a,
                                                    const Polynomial& b) const {
  const std::size_t terms = a.terms().size() * b.terms().size();
  if (terms > most_terms_) return std::nullopt;
  atoms_->spend(1 + terms);
  return squares_roots_ ? with_squared_roots(a * b) : a * b;
}

Polynomial Expander::with_squared_roots(const Polynomial& p) const {
  std::vector<PolynomialTerm> terms = p.terms();
  bool changed = false;
  for (PolynomialTerm& term : terms) {
    AtomProduct& atoms = term.monomial.coefficients;
    for (std::size_t i = 0; i + 1 < atoms.size();) {
      const std::optional<cln::cl_RA> square =
          atoms[i] == atoms[i + 1] ? square_of(atoms_->coefficient_expression(atoms[i]))
                                   : std::nullopt;
      if (!square) {
        ++i;
        continue;
      }
      term.factor = term.factor * *square;
      atoms.erase(i, 2);
      changed = true;
    }
  }
  return changed ? Polynomial(std::move(terms)) : p;
}

std::optional<Polynomial> Expander::expand_product(const Expressions& factors) {
  std::optional<Polynomial> result = Polynomial(cln::cl_RA(1));
  for (const Expression& factor : factors) {
    const std::optional<Polynomial> p = expand(factor);
    if (!p) return std::nullopt;
    result = bounded_product(*result, *p);
    if (!result) return std::nullopt;
  }
  return result;
}

std::optional<Polynomial> Expander::expand_power(const Expression& e) {
  const Expression& base = e.operands()[0];
  const int exponent = e.exponent();
  if (exponent > kLargestExpandedExponent || exponent < -kLargestExpandedExponent) return atom(e);
  const std::optional<Polynomial> p = exponent < 0 ? atom(power(base, -1)) : expand(base);
  if (!p) return std::nullopt;
  std::optional<Polynomial> result = p;
  for (int i = 1; i < (exponent < 0 ? -exponent : exponent) && result; ++i)
    result = bounded_product(*result, *p);
  return result;
}

}  // namespace regulus::detail
