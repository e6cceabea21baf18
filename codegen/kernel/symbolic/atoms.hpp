// SPDX-License-Identifier: GPL-3.0-or-later
// The indeterminates of polynomials: variables, and expressions that are not polynomials in them.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "codegen/kernel/symbolic/expression.hpp"
#include "codegen/support/work_meter.hpp"

namespace regulus::detail {

using Atom = char16_t;

/// A product of atoms, in increasing order, each repeated as often as its exponent. Up to degree
/// seven a string allocates no memory.
using AtomProduct = std::u16string;

/// Numbers atoms in two series: variables, calls and 1/(…) in one; in the other, the atoms without
/// variables (entries of K, pi, sqrt(3), …), which form the coefficients.
class AtomTable {
 public:
  /// The variables get the first numbers, in their order; the entries of K likewise. `meter` counts
  /// the work on polynomials over these atoms; null: no count.
  AtomTable(const std::vector<std::string>& variables, const std::vector<std::string>& points,
            WorkMeter* meter = nullptr);

  /// Counts terms that are about to be produced; see WorkMeter.
  void spend(std::uint64_t terms) const {
    if (meter_ != nullptr) meter_->spend(terms);
  }

  /// Requires  the expression is not a constant, sum, product or positive power.
  [[nodiscard]] Atom variable_atom(const Expression& e) { return number(e, variables_); }
  [[nodiscard]] Atom coefficient_atom(const Expression& e) { return number(e, coefficients_); }

  [[nodiscard]] const Expression& variable_expression(Atom a) const { return variables_.list[a]; }
  [[nodiscard]] const Expression& coefficient_expression(Atom a) const {
    return coefficients_.list[a];
  }

  /// Returns the current count: their numbers are 0 … count − 1.
  [[nodiscard]] std::size_t variable_atoms() const noexcept { return variables_.list.size(); }
  [[nodiscard]] std::size_t coefficient_atoms() const noexcept { return coefficients_.list.size(); }

  /// An order for ties: by the first declared variable an atom depends on, then by content.
  [[nodiscard]] bool precedes(Atom a, Atom b) const;

 private:
  struct Series {
    Expressions list;
    std::unordered_map<Expression, Atom, ExpressionHash> numbers;
  };
  Atom number(const Expression& e, Series& series);
  [[nodiscard]] std::size_t first_variable(const Expression& e) const;

  WorkMeter* meter_;
  std::unordered_map<std::string, std::size_t> declared_;
  Series variables_, coefficients_;
  std::vector<std::size_t> ranks_;  // of the variable atoms
};

/// The product of two atom products.
[[nodiscard]] AtomProduct multiply(const AtomProduct& a, const AtomProduct& b);

/// Computes a/b. False if b does not divide a.
[[nodiscard]] bool divide(const AtomProduct& a, const AtomProduct& b, AtomProduct& quotient);

/// Lexicographic order of exponents, earlier atoms first: compatible with multiplication.
[[nodiscard]] bool lex_greater(const AtomProduct& a, const AtomProduct& b) noexcept;

[[nodiscard]] int exponent_of(const AtomProduct& p, Atom a) noexcept;

}  // namespace regulus::detail
