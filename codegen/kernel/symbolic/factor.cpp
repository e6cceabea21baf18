// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>

#include "codegen/kernel/symbolic/passes.hpp"

namespace regulus::detail {
namespace {

Polynomial coefficient_polynomial(const Polynomial& p, Group group) {
  std::vector<PolynomialTerm> terms(p.terms().begin() + static_cast<std::ptrdiff_t>(group.first),
                                    p.terms().begin() + static_cast<std::ptrdiff_t>(group.last));
  for (PolynomialTerm& term : terms) term.monomial.variables.clear();
  return Polynomial(std::move(terms));
}

}  // namespace

std::optional<CommonFactor> common_coefficient(const Polynomial& p) {
  const std::vector<Group> all = groups(p);
  if (all.size() < 2) return std::nullopt;
  CommonFactor result{coefficient_polynomial(p, all[0]), {}};
  // Rational factors need not be taken out: they cost no width.
  if (result.factor.terms().size() < 2) return std::nullopt;
  const cln::cl_RA lead = result.factor.terms()[0].factor;
  std::vector<PolynomialTerm> rest;
  for (const Group group : all) {
    const PolynomialTerm& first = p.terms()[group.first];
    const cln::cl_RA ratio = first.factor / lead;
    if (!(coefficient_polynomial(p, group) == result.factor * ratio)) return std::nullopt;
    rest.push_back({Monomial{first.monomial.variables, {}}, ratio});
  }
  result.rest = Polynomial(std::move(rest));
  return result;
}

std::optional<Factored> factor_split(const Polynomial& outer, const Polynomial& q,
                                     const Polynomial& r) {
  // A common monomial needs no factor of its own, because Horner finds it.
  if (groups(q).size() > 1)
    if (const auto s = divide_exactly(r, q)) return Factored{q, outer + *s};
  if (groups(r).size() > 1)
    if (const auto s = divide_exactly(q, r)) return Factored{r, outer * *s + Polynomial(1)};
  return std::nullopt;
}

}  // namespace regulus::detail
