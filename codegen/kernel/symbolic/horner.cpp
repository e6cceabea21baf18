// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <utility>

#include "codegen/kernel/symbolic/passes.hpp"

namespace regulus::detail {
namespace {

/// p = atom^exponent·inner + rest, and no term of the rest contains the atom.
struct Split {
  Polynomial outer;
  Polynomial inner;
  Polynomial rest;
};

/// Counts the monomials that contain each atom.
std::map<Atom, int> monomials_with(const Polynomial& p) {
  std::map<Atom, int> counts;
  for (const Group group : groups(p)) {
    const AtomProduct& variables = p.terms()[group.first].monomial.variables;
    for (std::size_t i = 0; i < variables.size(); ++i)
      if (i == 0 || variables[i] != variables[i - 1]) ++counts[variables[i]];
  }
  return counts;
}

class Nesting {
 public:
  Nesting(const AtomTable& atoms, const HornerOptions& options)
      : atoms_(atoms), options_(options) {}

  Expression form(const Polynomial& p) {
    if (p.is_zero()) return Expression(0);
    atoms_.spend(p.terms().size());
    const std::optional<Atom> atom = next_atom(p);
    if (!atom) return collect(p, atoms_);
    if (options_.factor)
      if (const auto common = common_coefficient(p))
        return product(collect(common->factor, atoms_), form(common->rest));
    if (options_.complete_squares)
      if (const auto square = completed_square(p, *atom)) return *square;
    const Split split = taken_out(p, *atom);
    if (options_.factor && !split.rest.is_zero())
      if (const auto factored = factor_split(split.outer, split.inner, split.rest))
        return product(form(factored->first), form(factored->second));
    atoms_.spend(1);
    Expression first = product(monomial(split.outer.terms().front().monomial.variables, atoms_),
                               form(split.inner));
    if (split.rest.is_zero()) return first;
    // In a list that an exception of form() leaves half made, gcc 12 destroys what is out of scope.
    Expression rest = form(split.rest);
    return sum({std::move(first), std::move(rest)});
  }

 private:
  /// Returns the atom to take out; none if no atom is in two monomials.
  std::optional<Atom> next_atom(const Polynomial& p) const {
    std::optional<Atom> best;
    int most = 0;
    for (const auto& [atom, count] : monomials_with(p)) {
      if (count < 2 || (best && !preferred(atom, count, *best, most))) continue;
      best = atom;
      most = count;
    }
    return best;
  }

  bool preferred(Atom atom, int count, Atom best, int most) const {
    if (options_.order == HornerOrder::kVariablesFirst && is_variable(atom) != is_variable(best))
      return is_variable(atom);
    return count != most ? count > most : atoms_.precedes(atom, best);
  }

  bool is_variable(Atom atom) const {
    return atoms_.variable_expression(atom).kind() == ExpressionKind::kVariable;
  }

  static Split taken_out(const Polynomial& p, Atom atom) {
    int least = 0;
    for (const PolynomialTerm& term : p.terms()) {
      const int exponent = exponent_of(term.monomial.variables, atom);
      if (exponent > 0 && (least == 0 || exponent < least)) least = exponent;
    }
    const AtomProduct outer(static_cast<std::size_t>(least), atom);
    std::vector<PolynomialTerm> inner, rest;
    for (const PolynomialTerm& term : p.terms()) {
      PolynomialTerm quotient{Monomial{{}, term.monomial.coefficients}, term.factor};
      const bool divisible = divide(term.monomial.variables, outer, quotient.monomial.variables);
      (divisible ? inner : rest).push_back(divisible ? std::move(quotient) : term);
    }
    return {Polynomial(std::vector<PolynomialTerm>{{Monomial{outer, {}}, 1}}),
            Polynomial(std::move(inner)), Polynomial(std::move(rest))};
  }

  /// Completes the square if p is a·t² + b·t plus terms without t, with rational a and b.
  std::optional<Expression> completed_square(const Polynomial& p, Atom t) {
    cln::cl_RA a = 0, b = 0;
    for (const PolynomialTerm& term : p.terms()) {
      const AtomProduct& variables = term.monomial.variables;
      const int exponent = exponent_of(variables, t);
      if (exponent == 0) continue;
      const bool alone = static_cast<int>(variables.size()) == exponent &&
                         term.monomial.coefficients.empty() && exponent <= 2;
      if (!alone) return std::nullopt;
      (exponent == 2 ? a : b) = term.factor;
    }
    if (zerop(a) || zerop(b)) return std::nullopt;
    std::vector<PolynomialTerm> rest;
    for (const PolynomialTerm& term : p.terms())
      if (exponent_of(term.monomial.variables, t) == 0) rest.push_back(term);
    const cln::cl_RA shift = b / (2 * a);
    const Polynomial remainder = Polynomial(std::move(rest)) + Polynomial(-a * shift * shift);
    const Expression square = power(sum({atoms_.variable_expression(t), Expression(shift)}), 2);
    return sum({product({Expression(a), square}), form(remainder)});
  }

  const AtomTable& atoms_;
  const HornerOptions options_;
};

}  // namespace

bool can_nest(const Polynomial& p) {
  const std::map<Atom, int> counts = monomials_with(p);
  return std::any_of(counts.begin(), counts.end(), [](const auto& c) { return c.second > 1; });
}

Expression horner(const Polynomial& p, const AtomTable& atoms, const HornerOptions& options) {
  return Nesting(atoms, options).form(p);
}

}  // namespace regulus::detail
