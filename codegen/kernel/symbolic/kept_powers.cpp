// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/kept_powers.hpp"

#include <algorithm>
#include <utility>

#include "codegen/kernel/symbolic/evaluate.hpp"

namespace regulus::detail {
namespace {

/// No model has such a name.
std::string name_of_power(std::size_t number) { return "power#" + std::to_string(number); }

bool is_power_of_sum(const Expression& e) {
  return e.kind() == ExpressionKind::kPower && e.exponent() > 1 &&
         e.operands()[0].kind() == ExpressionKind::kSum;
}

/// Removes one pair of f and 1/f; the f of the pair.
std::optional<Expression> remove_pair(AtomProduct& product, const AtomTable& atoms) {
  for (std::size_t i = 0; i < product.size(); ++i) {
    const Expression& inverse = atoms.variable_expression(product[i]);
    if (inverse.kind() != ExpressionKind::kPower || inverse.exponent() != -1) continue;
    for (std::size_t j = 0; j < product.size(); ++j) {
      if (!(atoms.variable_expression(product[j]) == inverse.operands()[0])) continue;
      Expression removed = inverse;
      product.erase(std::max(i, j), 1);
      product.erase(std::min(i, j), 1);
      return removed;
    }
  }
  return std::nullopt;
}

}  // namespace

Expression KeptPowers::hide(const Expression& e) {
  return substitute(e, [this](const Expression& part) { return replacement(part); });
}

Expression KeptPowers::reveal(const Expression& e) const {
  return substitute(e, [this](const Expression& part) -> std::optional<Expression> {
    if (part.kind() != ExpressionKind::kVariable) return std::nullopt;
    for (std::size_t k = 0; k < powers_.size(); ++k)
      if (part.name() == name_of_power(k)) return powers_[k];
    return std::nullopt;
  });
}

std::vector<std::string> KeptPowers::names() const {
  std::vector<std::string> result;
  for (std::size_t k = 0; k < most_; ++k) result.push_back(name_of_power(k));
  return result;
}

Polynomial KeptPowers::without_inverses(const Polynomial& p, const AtomTable& atoms) {
  std::vector<PolynomialTerm> terms = p.terms();
  for (PolynomialTerm& term : terms)
    while (const auto inverse = remove_pair(term.monomial.variables, atoms))
      static_cast<void>(required(reveal(*inverse)));
  return Polynomial(std::move(terms));
}

std::optional<Expression> KeptPowers::replacement(const Expression& e) {
  if (is_power_of_sum(e)) return kept(e);
  return e.kind() == ExpressionKind::kCall ? related(e) : std::nullopt;
}

std::optional<Expression> KeptPowers::kept(const Expression& e) {
  const auto known = std::find(powers_.begin(), powers_.end(), e);
  const std::size_t number = std::size_t(known - powers_.begin());
  if (known == powers_.end()) {
    if (powers_.size() == most_) return std::nullopt;
    powers_.push_back(e);
  }
  return variable(name_of_power(number));
}

std::optional<Expression> KeptPowers::related(const Expression& e) {
  const Expression& u = e.operands()[0];
  if (e.function() == Call::kTan) {
    const Expression inverse = required(power(call(Call::kCos, {u}), -1));
    return hide(call(Call::kSin, {u}) * inverse);
  }
  const bool is_root = e.function() == Call::kSqrt;
  if ((!is_root && e.function() != Call::kLog) || u.kind() != ExpressionKind::kProduct)
    return std::nullopt;
  Expressions parts;
  for (const Expression& factor : u.operands())
    parts.push_back(hide(required(call(e.function(), {factor}))));
  return is_root ? product(std::move(parts)) : sum(std::move(parts));
}

Expression KeptPowers::required(const Expression& e) {
  if (std::find(must_be_defined_.begin(), must_be_defined_.end(), e) == must_be_defined_.end())
    must_be_defined_.push_back(e);
  return e;
}

}  // namespace regulus::detail
