// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "codegen/kernel/symbolic/polynomial.hpp"

namespace regulus::detail {

/// The derivatives of symbols that stand for functions of the variables.
class DerivativesOfSymbols {
 public:
  DerivativesOfSymbols() = default;
  DerivativesOfSymbols(const DerivativesOfSymbols&) = delete;
  DerivativesOfSymbols& operator=(const DerivativesOfSymbols&) = delete;
  virtual ~DerivativesOfSymbols() = default;
  /// Returns 0 for a symbol that stands for itself.
  [[nodiscard]] virtual Expression derivative(const std::string& symbol,
                                              const std::string& variable) = 0;
};

/// ∂/∂variable by the chain rule, one shared result for each shared sub-expression.
///
/// Ensures   exact wherever the expression is differentiable. The derivative may be defined where
///           the expression is not (log x, atan2 across its cut). The derivative of abs is
///           undefined at 0. A caller that bounds a function by its derivative must also ensure
///           that the function is defined.
class Differentiator {
 public:
  /// `symbols`: null, or it outlives this object.
  explicit Differentiator(std::string with_respect_to, DerivativesOfSymbols* symbols = nullptr)
      : variable_(std::move(with_respect_to)), symbols_(symbols) {}

  [[nodiscard]] Expression derivative(const Expression& e);

 private:
  Expression computed(const Expression& e);
  Expression of_product(const Expressions& factors);
  Expression of_call(const Expression& e);

  std::string variable_;
  DerivativesOfSymbols* symbols_;
  std::unordered_map<Expression, Expression, ExpressionHash> known_;
};

/// ∂/∂variable of polynomials over one table of atoms, through the derivatives of the atoms.
class PolynomialDifferentiator {
 public:
  /// `symbols`: see Differentiator.
  PolynomialDifferentiator(std::string with_respect_to, const AtomTable& atoms, Expander& expander,
                           DerivativesOfSymbols* symbols = nullptr)
      : differentiator_(std::move(with_respect_to), symbols),
        atoms_(&atoms),
        expander_(&expander) {}

  [[nodiscard]] Polynomial derivative(const Polynomial& p);

 private:
  const Polynomial& of_atom(Atom a);

  Differentiator differentiator_;
  const AtomTable* atoms_;
  Expander* expander_;
  std::map<Atom, Polynomial> known_;
};

}  // namespace regulus::detail
