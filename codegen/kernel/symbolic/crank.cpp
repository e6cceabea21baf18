// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/crank.hpp"

#include <cln/rational.h>

#include <utility>

#include "codegen/kernel/symbolic/evaluate.hpp"
#include "codegen/kernel/symbolic/passes.hpp"

namespace regulus::detail {
namespace {

/// scale·base².
struct Square {
  cln::cl_RA scale = 1;
  Expression base;
};

std::optional<Square> as_square(const Expression& term) {
  const bool is_product = term.kind() == ExpressionKind::kProduct;
  Square square;
  Expressions bases;
  for (const Expression& factor : is_product ? term.operands() : Expressions{term}) {
    if (factor.kind() == ExpressionKind::kConstant)
      square.scale = square.scale * factor.value();
    else if (factor.kind() == ExpressionKind::kPower && factor.exponent() % 2 == 0)
      bases.push_back(power(factor.operands()[0], factor.exponent() / 2));
    else
      return std::nullopt;
  }
  if (bases.empty()) return std::nullopt;
  square.base = product(std::move(bases));
  return square;
}

std::optional<cln::cl_RA> rational_root(const cln::cl_RA& x) {
  cln::cl_RA root = 0;
  if (cln::minusp(x) || cln::zerop(x) || !cln::sqrtp(x, &root)) return std::nullopt;
  return root;
}

/// The only square root with variables in e that is not inside another function; none if there are
/// two.
struct RootSearch {
  std::optional<Expression> root;
  bool several = false;

  void visit(const Expression& e) {
    if (!e.has_variables()) return;
    if (e.kind() == ExpressionKind::kCall) {
      if (e.function() != Call::kSqrt) return;
      if (root && !(*root == e)) several = true;
      root = e;
      return;
    }
    for (const Expression& operand : e.operands()) visit(operand);
  }
};

/// f = factor_f·base_f, …; root = factor_w·√(f² + g² − k²).
struct Closure {
  Expression base_f, base_g, base_k, root;
  cln::cl_RA factor_f, factor_k, factor_w;
  cln::cl_RA of_denominator;  ///< denominator = of_denominator·(f² + g²)
};

/// Reads the denominator: r₁·B₁² + r₂·B₂² is r₂·(f² + g²) with f = √(r₁/r₂)·B₁ and g = B₂.
bool read_denominator(const Expression& denominator, Closure& c) {
  if (denominator.kind() != ExpressionKind::kSum || denominator.operands().size() != 2)
    return false;
  const auto first = as_square(denominator.operands()[0]);
  const auto second = as_square(denominator.operands()[1]);
  if (!first || !second) return false;
  const auto ratio = rational_root(first->scale / second->scale);
  if (!ratio) return false;
  c.base_f = first->base;
  c.base_g = second->base;
  c.factor_f = *ratio;
  c.of_denominator = second->scale;
  return true;
}

/// Reads the radicand: σ·(f² + g²) − r·B², where k = √(r/σ)·B.
bool read_radicand(const Expression& radicand, Closure& c) {
  if (radicand.kind() != ExpressionKind::kSum || radicand.operands().size() != 3) return false;
  std::optional<cln::cl_RA> of_f, of_g, of_k;
  for (const Expression& term : radicand.operands()) {
    const auto square = as_square(term);
    if (!square) return false;
    if (square->base == c.base_f) {
      of_f = square->scale / (c.factor_f * c.factor_f);
    } else if (square->base == c.base_g) {
      of_g = square->scale;
    } else {
      of_k = -square->scale;
      c.base_k = square->base;
    }
  }
  if (!of_f || !of_g || !of_k || *of_f != *of_g) return false;
  const auto of_w = rational_root(*of_g), ratio = rational_root(*of_k / *of_g);
  if (!of_w || !ratio) return false;
  c.factor_w = *of_w;
  c.factor_k = *ratio;
  return true;
}

/// The part of a polynomial in one atom that is without it, and the factor of its first power.
struct Linear {
  Polynomial constant, slope;
};

std::optional<Linear> linear_in(const Polynomial& p, Atom atom) {
  std::vector<PolynomialTerm> constant, slope;
  for (const PolynomialTerm& term : p.terms()) {
    const int exponent = exponent_of(term.monomial.variables, atom);
    if (exponent > 1) return std::nullopt;
    if (exponent == 0) {
      constant.push_back(term);
      continue;
    }
    PolynomialTerm quotient = term;
    quotient.monomial.variables.erase(quotient.monomial.variables.find(atom), 1);
    slope.push_back(std::move(quotient));
  }
  return Linear{Polynomial(std::move(constant)), Polynomial(std::move(slope))};
}

/// Compares a numerator with multiples of k·f ± w·g and k·g ∓ w·f.
class Comparison {
 public:
  explicit Comparison(const Closure& c)
      : closure_(c), atoms_({"crank#f", "crank#g", "crank#k", "crank#w"}, {}), expander_(atoms_) {}

  std::optional<CrankCoordinate> compare(const Expression& numerator) {
    const std::optional<Polynomial> p = expander_.expand(
        substitute(numerator, [this](const Expression& e) { return symbol_of(e); }));
    if (!p) return std::nullopt;
    const auto linear = linear_in(*p, atom("w"));
    if (!linear || linear->constant.is_zero() || linear->slope.is_zero()) return std::nullopt;
    if (auto cosine = matched(*linear, "f", "g", false)) return cosine;
    return matched(*linear, "g", "f", true);
  }

 private:
  static Expression named(const char* letter) { return variable(std::string("crank#") + letter); }
  Atom atom(const char* letter) { return atoms_.variable_atom(named(letter)); }
  Polynomial polynomial(const char* letter) { return expander_.atom(named(letter)); }

  std::optional<Expression> symbol_of(const Expression& e) const {
    if (e == closure_.root) return Expression(closure_.factor_w) * named("w");
    if (e == closure_.base_k) return Expression(1 / closure_.factor_k) * named("k");
    if (e == closure_.base_f) return Expression(1 / closure_.factor_f) * named("f");
    if (e == closure_.base_g) return named("g");
    return std::nullopt;
  }

  /// factor·(k·first + W·second) for a cosine, factor·(k·first − W·second) for a sine.
  std::optional<CrankCoordinate> matched(const Linear& p, const char* first, const char* second,
                                         bool is_sine) {
    const auto factor = divide_exactly(p.constant, polynomial("k") * polynomial(first));
    if (!factor) return std::nullopt;
    for (const PolynomialTerm& term : factor->terms())
      for (const char* letter : {"f", "g", "k"})
        if (exponent_of(term.monomial.variables, atom(letter)) != 0) return std::nullopt;
    const Polynomial slope = *factor * polynomial(second);
    const bool same = p.slope == slope;
    if (!same && !(p.slope == slope * cln::cl_RA(-1))) return std::nullopt;
    const Expression f = Expression(closure_.factor_f) * closure_.base_f;
    const Expression k = Expression(closure_.factor_k) * closure_.base_k;
    return CrankCoordinate{{f, closure_.base_g, k, same == is_sine ? -1 : 1, closure_.root,
                            closure_.factor_w, length()},
                           is_sine,
                           Expression(1 / closure_.of_denominator) * collect(*factor, atoms_)};
  }

  /// k contains μ·g² or μ·f² with c·μ = 1/2.
  std::optional<cln::cl_RA> length() const {
    if (closure_.base_k.kind() != ExpressionKind::kSum) return std::nullopt;
    for (const Expression& term : closure_.base_k.operands()) {
      const auto square = as_square(term);
      if (!square) continue;
      const cln::cl_RA scale = 2 * closure_.factor_k * square->scale;
      if (square->base == closure_.base_g) return 1 / scale;
      if (square->base == closure_.base_f) return closure_.factor_f * closure_.factor_f / scale;
    }
    return std::nullopt;
  }

  const Closure& closure_;
  AtomTable atoms_;
  Expander expander_;
};

}  // namespace

std::optional<CrankCoordinate> find_crank(const Expression& numerator,
                                          const Expression& denominator) {
  Closure closure;
  if (!read_denominator(denominator, closure)) return std::nullopt;
  RootSearch search;
  search.visit(numerator);
  if (!search.root || search.several) return std::nullopt;
  closure.root = *search.root;
  if (!read_radicand(closure.root.operands()[0], closure)) return std::nullopt;
  return Comparison(closure).compare(numerator);
}

}  // namespace regulus::detail
