// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "codegen/kernel/symbolic/passes.hpp"

namespace regulus::detail {
namespace {

/// The products of variable atoms of a polynomial, in its order, with their coefficients (polynomials
/// in K's entries). The polynomial outlives it.
class ByMonomial {
 public:
  ByMonomial() = default;
  explicit ByMonomial(const Polynomial& p) : terms_(&p.terms()), groups_(groups(p)) {}

  [[nodiscard]] std::size_t size() const noexcept { return groups_.size(); }
  [[nodiscard]] const AtomProduct& variables(std::size_t group) const {
    return (*terms_)[groups_[group].first].monomial.variables;
  }
  [[nodiscard]] Polynomial coefficient(std::size_t group) const {
    std::vector<PolynomialTerm> terms;
    for (std::size_t i = groups_[group].first; i < groups_[group].last; ++i)
      terms.push_back({Monomial{{}, (*terms_)[i].monomial.coefficients}, (*terms_)[i].factor});
    return Polynomial(std::move(terms));
  }
  /// Returns size() if there is none.
  [[nodiscard]] std::size_t find(const AtomProduct& product) const {
    const auto before = [this](const Group& group, const AtomProduct& of) {
      return lex_greater((*terms_)[group.first].monomial.variables, of);
    };
    const auto found = std::lower_bound(groups_.begin(), groups_.end(), product, before);
    const auto number = static_cast<std::size_t>(found - groups_.begin());
    return found != groups_.end() && variables(number) == product ? number : size();
  }

 private:
  const std::vector<PolynomialTerm>* terms_ = nullptr;
  std::vector<Group> groups_;
};

Polynomial times_variables(const Polynomial& coefficient, const AtomProduct& variables) {
  std::vector<PolynomialTerm> terms = coefficient.terms();
  for (PolynomialTerm& term : terms)
    term.monomial.variables = multiply(term.monomial.variables, variables);
  return Polynomial(std::move(terms));
}

/// sin u and cos u as atoms.
struct Angle {
  Expression argument;
  Atom sine;
  Atom cosine;
};

AtomProduct pair(Atom a, Atom b) { return multiply(AtomProduct(1, a), AtomProduct(1, b)); }

class AngleMerger {
 public:
  AngleMerger(const Polynomial& p, AtomTable& atoms, Expander& expander,
              const std::function<Expression(const Expression&)>& simplify,
              const TrigonometricOptions& options)
      : p_(p), atoms_(atoms), expander_(expander), simplify_(simplify), options_(options) {}

  /// Every step reduces the number of monomials or their degrees, so the loop ends.
  Polynomial run() {
    while (step()) {
    }
    return p_;
  }

 private:
  bool step() {
    const std::vector<Angle> angles = find_angles();
    if (angles.empty()) return false;
    atoms_.spend(p_.terms().size());
    monomials_ = ByMonomial(p_);
    for (const Angle& a : angles)
      if (merge_squares(a) || (options_.double_angles && merge_double(a))) return true;
    if (!options_.sums) return false;
    for (std::size_t i = 0; i < angles.size(); ++i)
      for (std::size_t j = i + 1; j < angles.size(); ++j)
        if (merge_pair(angles[i], angles[j])) return true;
    return false;
  }

  std::vector<Angle> find_angles() {
    AtomProduct seen;
    std::vector<bool> is_seen;
    for (const PolynomialTerm& term : p_.terms())
      for (const Atom a : term.monomial.variables) {
        if (a >= is_seen.size()) is_seen.resize(std::size_t{a} + 1);
        if (!is_seen[a]) seen.push_back(a);
        is_seen[a] = true;
      }
    std::sort(seen.begin(), seen.end(), [&](Atom a, Atom b) { return atoms_.precedes(a, b); });
    std::vector<Angle> angles;
    for (const Atom a : seen) {
      const Expression e = atoms_.variable_expression(a);
      if (e.kind() != ExpressionKind::kCall ||
          (e.function() != Call::kSin && e.function() != Call::kCos))
        continue;
      const Expression argument = e.operands()[0];
      const bool known = std::any_of(angles.begin(), angles.end(),
                                     [&](const Angle& b) { return b.argument == argument; });
      if (known) continue;
      angles.push_back({argument, atoms_.variable_atom(call(Call::kSin, {argument})),
                        atoms_.variable_atom(call(Call::kCos, {argument}))});
    }
    return angles;
  }

  /// f·s² + g·c² = f + (g − f)·c².
  bool merge_squares(const Angle& u) {
    const AtomProduct s2(2, u.sine), c2(2, u.cosine);
    return rewrite_pairs(s2, c2, [&](const Polynomial& f, const Polynomial& g) {
      if (options_.double_angles && (f + g).is_zero())
        return std::optional(circular(Call::kCos, {u.argument, u.argument}, g));
      return std::optional(f + times_variables(g + f * cln::cl_RA(-1), c2));
    });
  }

  /// f·s·c = f·sin(2u)/2.
  bool merge_double(const Angle& u) {
    const AtomProduct sc = pair(u.sine, u.cosine);
    AtomProduct cofactor;
    for (std::size_t m = 0; m < monomials_.size(); ++m) {
      if (!divide(monomials_.variables(m), sc, cofactor)) continue;
      const Polynomial f = monomials_.coefficient(m);
      replace(
          {{monomials_.variables(m), f}},
          times_variables(circular(Call::kSin, {u.argument, u.argument}, f) * (cln::cl_RA(1) / 2),
                          cofactor));
      return true;
    }
    return false;
  }

  bool merge_pair(const Angle& u, const Angle& v) {
    const Expression minus_v = -v.argument;
    const auto merged = [&](Call function, int sign_for_sum) {
      return [&, function, sign_for_sum](const Polynomial& f,
                                         const Polynomial& g) -> std::optional<Polynomial> {
        const int sign = f == g ? 1 : ((f + g).is_zero() ? -1 : 0);
        if (sign == 0) return std::nullopt;
        const Expression& second = sign == sign_for_sum ? v.argument : minus_v;
        return circular(function, {u.argument, second}, f);
      };
    };
    // cos u cos v ∓ sin u sin v = cos(u ± v); sin u cos v ± cos u sin v = sin(u ± v).
    return rewrite_pairs(pair(u.cosine, v.cosine), pair(u.sine, v.sine), merged(Call::kCos, -1)) ||
           rewrite_pairs(pair(u.sine, v.cosine), pair(u.cosine, v.sine), merged(Call::kSin, 1));
  }

  /// Replaces f·first·m + g·second·m by merge(f, g)·m for the first cofactor m where that exists.
  template <class Merge>
  bool rewrite_pairs(const AtomProduct& first, const AtomProduct& second, const Merge& merge) {
    atoms_.spend(monomials_.size());
    AtomProduct cofactor;
    for (std::size_t m = 0; m < monomials_.size(); ++m) {
      if (!divide(monomials_.variables(m), first, cofactor)) continue;
      const std::size_t partner = monomials_.find(multiply(cofactor, second));
      if (partner == monomials_.size()) continue;
      const Polynomial f = monomials_.coefficient(m), g = monomials_.coefficient(partner);
      const std::optional<Polynomial> merged = merge(f, g);
      if (!merged) continue;
      replace({{monomials_.variables(m), f}, {monomials_.variables(partner), g}},
              times_variables(*merged, cofactor));
      return true;
    }
    return false;
  }

  void replace(const std::vector<std::pair<AtomProduct, Polynomial>>& old,
               const Polynomial& replacement) {
    Polynomial change = replacement;
    for (const auto& [variables, coefficient] : old)
      change = change + times_variables(coefficient, variables) * cln::cl_RA(-1);
    p_ = p_ + change;
  }

  /// factor·function(Σ arguments). Even and odd symmetry give each angle one form.
  Polynomial circular(Call function, Expressions arguments, const Polynomial& factor) {
    const Signed argument = normalize_sign(simplify_(sum(std::move(arguments))));
    const Expression value = call(function, {argument.form});
    const Polynomial atom = value.kind() == ExpressionKind::kConstant ? Polynomial(value.value())
                                                                      : expander_.atom(value);
    const bool negative = function == Call::kSin && argument.sign < 0;
    return atom * factor * cln::cl_RA(negative ? -1 : 1);
  }

  Polynomial p_;
  ByMonomial monomials_;  // of p_
  AtomTable& atoms_;
  Expander& expander_;
  const std::function<Expression(const Expression&)>& simplify_;
  const TrigonometricOptions options_;
};

}  // namespace

Polynomial merge_angles(const Polynomial& p, AtomTable& atoms, Expander& expander,
                        const std::function<Expression(const Expression&)>& simplify,
                        const TrigonometricOptions& options) {
  return AngleMerger(p, atoms, expander, simplify, options).run();
}

}  // namespace regulus::detail
