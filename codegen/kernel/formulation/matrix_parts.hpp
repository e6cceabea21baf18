// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of a matrix that are not polynomials, as symbols.
//
// An entry of a rotary leg's row is a polynomial in the pose, and in parts with roots and quotients
// that belong to this leg alone: the rod's direction is X + R·b − a − crank·(C, S). Multiplied out
// over the symbols, the terms that rows share are collected in K·A as those of a Gough platform are
// (T-RO 2007, §III-B1, form 2), and the parts stay whole.
//
// The parts have forms of their own. Let (C, S) be a crank (symbolic/crank.hpp), at the angle τ.
// From k = C·f + S·g follows
//
//   ∂τ = (∂k − C·∂f − S·∂g)/W = (P·∂f + Q·∂g + n)/(c·W),    ∂C = −S·∂τ,    ∂S = C·∂τ,
//   P = f − c·C,    Q = g − c·S,    n = c·∂k − f·∂f − g·∂g,    ∂W = C·∂g − S·∂f − k·∂τ
//
// for any number c. With the crank's length, (P, Q) is the rod in the plane of the crank, and n what
// the change of f² + g² leaves of that of 2·c·k: 0 in the plane. The chain rule on (k·f + W·g)/q has
// terms that cancel, and intervals do not see it.
//
//   C = cos(β ∓ α),   S = sin(β ∓ α),   β = atan2(g, f),   α = acos(k/√q)
//
// holds wherever both sides are defined: cos α = k/√q, sin α = |W|/√q. With m = 2·c·k − q, which in
// the plane is c² − (length of the rod)²,
//
//   k/√q = (√q + m/√q)/(2·c),    q − k² = (c² − m) − (k − c)²
//
// have q in other places.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "codegen/kernel/formulation/sample_widths.hpp"
#include "codegen/kernel/symbolic/crank.hpp"
#include "codegen/kernel/symbolic/derivative.hpp"
#include "codegen/kernel/symbolic/evaluate.hpp"
#include "codegen/kernel/symbolic/rewrite.hpp"

namespace regulus::detail {

class MatrixParts final : public DerivativesOfSymbols {
 public:
  /// A symbol, and what it stands for in symbols before it.
  struct Part {
    std::string name;
    Expression value;
  };

  /// `rewriter` gives polynomials their forms, and `of_parts` expressions with roots and quotients;
  /// `variables` are those of both, with typical ranges. All outlive this object.
  MatrixParts(const std::vector<Variable>& variables, Rewriter& rewriter, Rewriter& of_parts);

  /// Returns e with symbols in the place of parts that are not total.
  ///
  /// Ensures   reveal(hide(e)) is the same function wherever e and the result are defined.
  [[nodiscard]] Expression hide(const Expression& e);

  /// Returns the expression over the variables.
  [[nodiscard]] Expression reveal(const Expression& e);

  /// Returns e with other forms of the roots of cranks. It is defined at the same points.
  [[nodiscard]] Expression sharpened(const Expression& e) const;

  [[nodiscard]] Expression derivative(const std::string& symbol,
                                      const std::string& variable) override;

  [[nodiscard]] bool empty() const noexcept { return parts_.empty(); }
  [[nodiscard]] const std::vector<Part>& parts() const noexcept { return parts_; }

 private:
  using Rule = std::function<Expression(const std::string& variable)>;

  /// A crank with its symbols.
  struct KnownCrank {
    Crank crank;
    std::size_t number;
    Expression f, g, k;          ///< forms
    Expression squared_lever;    ///< q − k², in the form of least width
    Expression cosine_of_alpha;  ///< k/√q, likewise
    Expression cosine, sine, along, across, lever;
  };

  Expression hide_product(const Expressions& factors);
  Expression symbol(const std::string& name, const Expression& value, Rule rule);
  /// A symbol for a value over the variables, with the chain rule.
  Expression part(const Expression& value);
  /// The form of a derivative: a symbol, unless it is one term.
  Expression piece(const Expression& value);
  Expression derivative_piece(const Expression& value, const std::string& variable);
  Expression root(const Expression& value);
  const KnownCrank& known(const Crank& crank);
  void add_symbols(KnownCrank& crank);
  void choose_forms(KnownCrank& crank) const;
  void choose_coordinates(const KnownCrank& crank, Expression& cosine, Expression& sine) const;
  /// ∂τ by a variable.
  Expression turn(const KnownCrank& crank, const std::string& variable);
  Expression turn_value(const KnownCrank& crank, const std::string& variable);
  Expression lever_derivative(const KnownCrank& crank, const std::string& variable);
  Expression turn_derivative(const KnownCrank& crank, const std::string& first,
                             const std::string& second);
  Expression form_of(const Expression& value);
  Differentiator& by(const std::string& variable);

  Rewriter& rewriter_;
  Rewriter& of_parts_;
  const SampleWidths widths_;
  std::vector<Part> parts_;
  std::map<std::string, Rule> rules_;
  std::map<std::pair<std::string, std::string>, Expression> derivatives_;
  std::unordered_map<Expression, Expression, ExpressionHash> symbols_;  // of values
  std::map<std::string, Expression> revealed_;
  std::map<std::string, Differentiator> by_;
  std::vector<std::unique_ptr<KnownCrank>> cranks_;
  Replacer revealing_;
};

}  // namespace regulus::detail
