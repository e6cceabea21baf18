// SPDX-License-Identifier: GPL-3.0-or-later
// Tries the rewriting passes and keeps the form with the least dependency.
#pragma once

#include <string>
#include <vector>

#include "codegen/kernel/symbolic/measure.hpp"
#include "codegen/kernel/symbolic/passes.hpp"

namespace regulus::detail {

struct RewriteOptions {
  /// Look for better forms. If false, an expression stays as it is, and a derivative is multiplied
  /// out.
  bool rewrite = true;
  bool horner = true;
  bool trigonometric = true;
  std::size_t most_terms = 20000;  ///< an expression that expands to more stays one indeterminate
  HornerOptions nesting;           ///< if `horner`; the order is chosen by trial
  Weights weights;                 ///< of the variables' occurrences, to compare forms
  bool squares_roots = false;      ///< see Expander
};

/// A form and the passes that found it.
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

  /// Returns the best form of e.
  ///
  /// Ensures   the same function wherever e is defined. width_cost(result) ≤ width_cost(e),
  ///           with the weights of the options.
  ///           A division or root may cancel: nothing is claimed where e is undefined.
  [[nodiscard]] Rewritten rewrite(const Expression& e);

  /// Returns e with the arguments of its functions and its denominators rewritten; the rest is
  /// unchanged.
  [[nodiscard]] Expression with_rewritten_arguments(const Expression& e);

  /// Returns the polynomial of e, after its arguments were rewritten; one indeterminate if it is
  /// too large.
  [[nodiscard]] Polynomial expand(const Expression& e);

  /// Returns the best of the forms of p, and of `natural` if it is given.
  [[nodiscard]] Rewritten best_form(const Polynomial& p, const Expression* natural = nullptr);

  /// Returns the best of the nested forms of p, without merging angles: the time grows little
  /// faster than the number of terms; with merging, it would grow as its square.
  [[nodiscard]] Rewritten nested_form(const Polynomial& p);
  /// Returns the Horner form of p if the options allow it, without a search for a better one.
  [[nodiscard]] Rewritten quick_form(const Polynomial& p);

  /// Sets the weight of a variable's occurrences, for the forms to come.
  void weigh(const std::string& name, std::uint64_t weight) {
    options_.weights.insert_or_assign(name, weight);
  }

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

}  // namespace regulus::detail
