// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <utility>

#include "codegen/kernel/symbolic/passes.hpp"

namespace regulus::detail {
namespace {

Expression coefficient_product(const AtomProduct& product_of, const AtomTable& atoms) {
  if (product_of.size() == 1) return atoms.coefficient_expression(product_of.front());
  Expressions factors;
  factors.reserve(product_of.size());
  for (const Atom a : product_of) factors.push_back(atoms.coefficient_expression(a));
  return product(std::move(factors));
}

/// ±(e_1 ± e_2 …): the terms with factors of one magnitude. The first is added, not subtracted.
struct Magnitude {
  cln::cl_RA factor;  // of the first
  Expressions terms;
};

std::vector<Magnitude> by_magnitude(const Polynomial& p, const AtomTable& atoms, Group group) {
  std::vector<Magnitude> magnitudes;
  for (std::size_t i = group.first; i < group.last; ++i) {
    const PolynomialTerm& term = p.terms()[i];
    const Expression e = coefficient_product(term.monomial.coefficients, atoms);
    const auto alike = std::find_if(magnitudes.begin(), magnitudes.end(), [&](const Magnitude& m) {
      return m.factor == term.factor || m.factor == -term.factor;
    });
    if (alike == magnitudes.end())
      magnitudes.push_back({term.factor, {e}});
    else
      alike->terms.push_back(alike->factor == term.factor ? e : -e);
  }
  return magnitudes;
}

/// factor·e.
Expression scaled(const cln::cl_RA& factor, Expression e) {
  return factor == 1 ? std::move(e) : product(Expression(factor), std::move(e));
}

}  // namespace

Expression coefficient(const Polynomial& p, const AtomTable& atoms, Group group) {
  // With the sign of its first term taken out, a coefficient and its negative have one form.
  const cln::cl_RA sign = minusp(p.terms()[group.first].factor) ? -1 : 1;
  Expressions terms;
  for (Magnitude& m : by_magnitude(p, atoms, group))
    terms.push_back(scaled(sign * m.factor, sum(std::move(m.terms))));
  return scaled(sign, sum(std::move(terms)));
}

Expression monomial(const AtomProduct& variables, const AtomTable& atoms) {
  Expressions factors;
  for (std::size_t i = 0; i < variables.size();) {
    const int exponent = exponent_of(variables, variables[i]);
    factors.push_back(power(atoms.variable_expression(variables[i]), exponent));
    i += static_cast<std::size_t>(exponent);
  }
  return factors.size() == 1 ? std::move(factors.front()) : product(std::move(factors));
}

Expression collect(const Polynomial& p, const AtomTable& atoms) {
  atoms.spend(p.terms().size());
  Expressions terms;
  for (const Group group : groups(p)) {
    const AtomProduct& variables = p.terms()[group.first].monomial.variables;
    Expression factor = coefficient(p, atoms, group);
    terms.push_back(variables.empty() ? std::move(factor)
                                      : product(std::move(factor), monomial(variables, atoms)));
  }
  return sum(std::move(terms));
}

}  // namespace regulus::detail
