// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/polynomial.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace regulus::detail {
namespace {

bool precedes(const PolynomialTerm& a, const PolynomialTerm& b) {
  return lex_greater(a.monomial, b.monomial);
}

void combine_like_terms(std::vector<PolynomialTerm>& terms) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < terms.size();) {
    cln::cl_RA factor = terms[i].factor;
    std::size_t next = i + 1;
    for (; next < terms.size() && terms[next].monomial == terms[i].monomial; ++next)
      factor = factor + terms[next].factor;
    if (!zerop(factor)) {
      if (kept != i) terms[kept].monomial = std::move(terms[i].monomial);
      terms[kept++].factor = factor;
    }
    i = next;
  }
  terms.resize(kept);
}

Monomial monomial_product(const Monomial& a, const Monomial& b) {
  return {multiply(a.variables, b.variables), multiply(a.coefficients, b.coefficients)};
}

bool divide_term(const PolynomialTerm& a, const PolynomialTerm& b, PolynomialTerm& quotient) {
  if (!divide(a.monomial.variables, b.monomial.variables, quotient.monomial.variables) ||
      !divide(a.monomial.coefficients, b.monomial.coefficients, quotient.monomial.coefficients))
    return false;
  quotient.factor = a.factor / b.factor;
  return true;
}

Polynomial times_term(const Polynomial& p, const PolynomialTerm& term) {
  std::vector<PolynomialTerm> terms;
  terms.reserve(p.terms().size());
  for (const PolynomialTerm& t : p.terms())
    terms.push_back({monomial_product(t.monomial, term.monomial), t.factor * term.factor});
  return Polynomial(std::move(terms));
}

}  // namespace

bool lex_greater(const Monomial& a, const Monomial& b) noexcept {
  if (a.variables != b.variables) return lex_greater(a.variables, b.variables);
  return lex_greater(a.coefficients, b.coefficients);
}

Polynomial::Polynomial(const cln::cl_RA& constant) {
  if (!zerop(constant)) terms_.push_back({Monomial{}, constant});
}

Polynomial::Polynomial(std::vector<PolynomialTerm> terms) : terms_(std::move(terms)) {
  if (!std::is_sorted(terms_.begin(), terms_.end(), precedes))
    std::sort(terms_.begin(), terms_.end(), precedes);
  combine_like_terms(terms_);
}

bool Polynomial::has_variables() const noexcept {
  return !terms_.empty() && !terms_.front().monomial.variables.empty();
}

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
  std::vector<PolynomialTerm> terms;
  terms.reserve(a.terms().size() + b.terms().size());
  std::merge(a.terms().begin(), a.terms().end(), b.terms().begin(), b.terms().end(),
             std::back_inserter(terms), precedes);
  return Polynomial(std::move(terms));
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  std::vector<PolynomialTerm> terms;
  terms.reserve(a.terms().size() * b.terms().size());
  for (const PolynomialTerm& s : a.terms())
    for (const PolynomialTerm& t : b.terms())
      terms.push_back({monomial_product(s.monomial, t.monomial), s.factor * t.factor});
  return Polynomial(std::move(terms));
}

Polynomial operator*(const Polynomial& a, const cln::cl_RA& factor) {
  return times_term(a, PolynomialTerm{Monomial{}, factor});
}

bool operator==(const Polynomial& a, const Polynomial& b) {
  return std::equal(a.terms().begin(), a.terms().end(), b.terms().begin(), b.terms().end(),
                    [](const PolynomialTerm& s, const PolynomialTerm& t) {
                      return s.monomial == t.monomial && s.factor == t.factor;
                    });
}

std::optional<Polynomial> divide_exactly(const Polynomial& a, const Polynomial& b) {
  if (a.is_zero()) return Polynomial();
  PolynomialTerm quotient;
  // The least terms must divide, too: this cheap test rejects nearly all pairs early.
  if (!divide_term(a.terms().back(), b.terms().back(), quotient)) return std::nullopt;
  std::vector<PolynomialTerm> quotients;
  Polynomial rest = a;
  while (!rest.is_zero()) {
    if (!divide_term(rest.terms().front(), b.terms().front(), quotient)) return std::nullopt;
    if (quotients.size() >= a.terms().size()) return std::nullopt;
    quotients.push_back(quotient);
    rest = rest + times_term(b, PolynomialTerm{quotient.monomial, -quotient.factor});
  }
  return Polynomial(std::move(quotients));
}

std::vector<Group> groups(const Polynomial& p) {
  std::vector<Group> result;
  for (std::size_t i = 0; i < p.terms().size(); ++i) {
    if (i > 0 &&
        p.terms()[i].monomial.variables == p.terms()[result.back().first].monomial.variables)
      result.back().last = i + 1;
    else
      result.push_back({i, i + 1});
  }
  return result;
}

}  // namespace regulus::detail
