// SPDX-License-Identifier: GPL-3.0-or-later
// Forms the functions of a kernel for formulate(); only for the files of this folder.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/formulation/matrix_parts.hpp"
#include "codegen/kernel/formulation/substitution.hpp"
#include "codegen/kernel/symbolic/derivative.hpp"
#include "codegen/kernel/symbolic/evaluate.hpp"
#include "codegen/kernel/symbolic/polynomial.hpp"

namespace regulus::detail {

[[nodiscard]] inline std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// True if any requested function uses the entries of A in other forms than those of the model.
[[nodiscard]] bool uses_matrix(const FormulationOptions& f);

/// Sets names, variables and sizes.
void set_shape(const Model& model, const Motion& motion, const Substitution& substitution,
               Formulation& of);

/// Forms the functions of one kernel, with one set of options. Use it for one run only.
class Formulator {
 public:
  /// `meter` counts the terms that are formed, `watch` may be null; both outlive this object.
  /// `hides_parts`: products with K and their derivatives are formed with symbols for parts of A
  /// (matrix_parts.hpp), and are multiplied out.
  Formulator(const Model& model, const Motion& motion, const FormulationOptions& options,
             bool hides_parts, WorkMeter& meter, const FormingWatch* watch);

  /// Throws InputError, ClosedFormError, OverBudget and FormingStopped.
  Formulation run();

 private:
  /// A in the forms for products with K.
  struct MatrixForms {
    std::vector<Polynomial> expanded;
    Expressions natural;  // as the model writes it
    Expressions formed;   // the same after column operations, not multiplied out
    Expressions rewritten;
  };

  /// A linear combination of entries of A with entries of K: one entry of K·A or of A·K.
  struct Entry {
    Polynomial polynomial;
    Expression natural;    // with the entries of A as the model writes them
    Expression rewritten;  // with the entries of A rewritten
  };

  [[nodiscard]] Rewriter& of_products() { return wide_ ? *wide_ : rewriter_; }
  /// Writes A with symbols for its parts.
  void hide_parts();
  /// Returns ∂/∂variable of products and of A as it is in them.
  [[nodiscard]] PolynomialDifferentiator differentiator(const std::string& variable);
  /// Returns the best of the forms of p and `natural`. Angles are not merged in long polynomials
  /// with symbols for parts, because that takes too long.
  Rewritten best_form(const Polynomial& p, const Expression* natural = nullptr);
  [[nodiscard]] Expression revealed(const Expression& e);
  /// Puts the parts in the place of their symbols.
  void reveal_parts();
  void form_natural_matrix();
  [[nodiscard]] bool may_have_threshold() const;
  void form_matrix();
  /// Replaces A by A·V if that has narrower bounds.
  void change_columns();
  void change_column(const AppliedOperation& operation);
  void form_matrix_derivatives();
  /// Forms det A over the motion. The entries of a rotation are expanded in sines and cosines. This
  /// gives fewer terms than entries as indeterminates, since it uses the relations between them.
  void form_determinant();
  [[nodiscard]] Occurrences counted(const Expression& e) const;
  Expression nested(const Polynomial& p, const std::string& function);
  /// Σ_j points[j]·A[entries[j]].
  Entry combine(const MatrixForms& A, const std::vector<std::string>& points,
                const std::vector<std::size_t>& entries);
  /// Returns the first row of K·A. Rows differ only in the names of K's entries.
  std::vector<Entry> first_row(const MatrixForms& A);
  void append_best_forms(const std::vector<Entry>& row, const std::string& function,
                         ProductForms& to);
  void form_left_product();
  void form_left_derivatives(const std::vector<Entry>& row);
  /// Appends a block of the first row.
  void append_block(const Expressions& block, const std::vector<EntryStatistics>& statistics,
                    ProductForms& to, std::vector<EntryStatistics>& statistics_to) const;
  void form_right_product();
  /// Returns for each variable the only row in which it occurs, if it is an uncertain quantity, or
  /// Expansion::kNoRow.
  [[nodiscard]] std::vector<int> rows_of_variables();
  [[nodiscard]] bool has_row_quantity();
  void form_expansion(bool at_nominal);
  /// Returns A with uncertain quantities at the given values.
  MatrixForms nominal_forms(const std::map<std::string, Expression>& values);
  /// Forms all derivatives that are not zero, from the first row of K·A.
  void form_expansion_of(const std::vector<Entry>& row);
  void append_column(DerivativeIndex place, const Polynomial& p, const std::string& function,
                     ProductDerivatives& to);
  /// Forms ∂A[i][j] by quantities that touch only row i, and the second derivatives for them.
  void form_row_derivatives(int i, int j, std::vector<PolynomialDifferentiator>& by);
  Expression rewritten(const Expression& natural, const std::string& function);
  void form_row_scale();
  void form_motion();
  void collect_must_be_defined();
  void append_partial(const GiNaC::ex& e, Expressions& to);
  /// Returns them in canonical order, without repetitions and without those that are part of
  /// another.
  [[nodiscard]] static Expressions outermost(const Expressions& all);

  const Model& model_;
  const Motion& motion_;
  const FormulationOptions options_;
  const bool needs_matrix_;
  WorkMeter uncounted_;  // for what no budget counts
  Substitution substitution_;
  std::vector<Variable> typical_;  // with the ranges by which choices are made
  Rewriter rewriter_;
  std::optional<Rewriter> wide_;  // of products, if they are formed with symbols for parts
  std::optional<MatrixParts> parts_;
  std::vector<Polynomial> entries_;  // of A, multiplied out over the variables
  MatrixForms forms_;                // of A
  Formulation result_;
};

}  // namespace regulus::detail
