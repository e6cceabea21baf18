// SPDX-License-Identifier: GPL-3.0-or-later
// Tries the rewriting passes and keeps the form with the least dependency.
#pragma once

#include <string>
#include <vector>

#include "codegen/symbolic/measure.hpp"
#include "codegen/symbolic/passes.hpp"

namespace regulus::inline symbolic {

struct RewriteOptions {
  /// Look for better forms; else an expression stays as it is written, a derivative is multiplied
  /// out.
  bool rewrite = true;
  bool horner = true;
  bool trigonometric = true;
  std::size_t most_terms = 20000;  ///< what multiplied out has more terms stays one indeterminate
  HornerOptions nesting;           ///< where `horner`; its order is chosen by trying
  Weights weights;                 ///< of the variables' occurrences, when forms are compared
};

/// A form and how it was found.
struct Rewritten {
  Expression expression;
  std::string passes;  ///< "natural", "collect", "horner", "angles + horner", …
};

/// Rewrites expressions in one set of variables. Results depend on the expressions and on the order
/// of the names alone.
class Rewriter {
 public:
  /// `variables` in the order in which ties between them are decided, `points` K's entries.
  /// `meter`: see AtomTable.
  Rewriter(const std::vector<std::string>& variables, const std::vector<std::string>& points,
           const RewriteOptions& options = {}, WorkMeter* meter = nullptr);
  Rewriter(const Rewriter&) = delete;
  Rewriter& operator=(const Rewriter&) = delete;

  /// The best form of e.
  ///
  /// Ensures   the same function wherever e is defined. width_cost(result) ≤ width_cost(e),
  ///           with the weights of the options.
  ///           A division or root may cancel: where e is undefined nothing is said.
  [[nodiscard]] Rewritten rewrite(const Expression& e);

  /// e with the arguments of its functions and its denominators rewritten, and else as it was.
  [[nodiscard]] Expression with_rewritten_arguments(const Expression& e);

  /// Of e, after its arguments were rewritten; as one indeterminate if that is too large.
  [[nodiscard]] Polynomial expand(const Expression& e);

  /// The best of the forms of p, and of `natural` if one is given.
  [[nodiscard]] Rewritten best_form(const Polynomial& p, const Expression* natural = nullptr);

  /// The best of the nested forms of p, its angles as they are: the time grows little faster than
  /// the number of terms, where merging angles takes its square.
  [[nodiscard]] Rewritten nested_form(const Polynomial& p);
  /// The Horner form of p if the options allow it, without looking for a better one.
  [[nodiscard]] Rewritten quick_form(const Polynomial& p);

  [[nodiscard]] AtomTable& atoms() noexcept { return atoms_; }
  [[nodiscard]] Expander& expander() noexcept { return expander_; }

 private:
  Expression prepared(const Expression& e);
  Expression argument_form(const Expression& e);
  Expression simplified_argument(const Expression& e);
  Polynomial merge(const Polynomial& p, bool double_angles);

  RewriteOptions options_;
  AtomTable atoms_;
  Expander expander_;
  std::unordered_map<Expression, Expression, ExpressionHash> prepared_;
};

}  // namespace regulus::inline symbolic
