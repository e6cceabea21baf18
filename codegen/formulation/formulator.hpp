// SPDX-License-Identifier: GPL-3.0-or-later
// How formulate() makes the functions of a kernel; for the files of this folder alone.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "codegen/formulation/formulation.hpp"
#include "codegen/formulation/substitution.hpp"
#include "codegen/symbolic/derivative.hpp"
#include "codegen/symbolic/evaluate.hpp"
#include "codegen/symbolic/polynomial.hpp"

namespace regulus::inline formulation {

/// Whether any function is asked for that is made of the entries of A in other forms than the
/// model's own.
[[nodiscard]] bool uses_matrix(const FormulationOptions& f);

/// Names, variables and sizes.
void set_shape(const Model& model, const Motion& motion, const Substitution& substitution,
               Formulation& of);

/// The functions of one kernel, with one set of options. For one run alone.
class Formulator {
 public:
  /// `meter` counts the terms that are formed, `watch` may be null; both outlive this object.
  Formulator(const Model& model, const Motion& motion, const FormulationOptions& options,
             WorkMeter& meter, const FormingWatch* watch);

  /// Throws InputError, ClosedFormError, OverBudget and FormingStopped.
  Formulation run();

 private:
  /// A in the forms that products with K are made of.
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

  void form_natural_matrix();
  [[nodiscard]] bool may_have_threshold() const;
  void form_matrix();
  /// From A to A·V where that has the narrower bounds.
  void change_columns();
  void change_column(const AppliedOperation& operation);
  void form_matrix_derivatives();
  /// det A over the motion: the entries of a rotation are multiplied out in sines and cosines,
  /// which leaves fewer terms than taking them as indeterminates would, since their relations are
  /// used.
  void form_determinant();
  Expression nested(const Polynomial& p, const std::string& function);
  /// Σ_j points[j]·A[entries[j]].
  Entry combine(const MatrixForms& A, const std::vector<std::string>& points,
                const std::vector<std::size_t>& entries);
  /// The first row of K·A. Rows differ in the names of K's entries alone.
  std::vector<Entry> first_row(const MatrixForms& A);
  void append_best_forms(const std::vector<Entry>& row, const std::string& function,
                         Expressions& to);
  void form_left_product();
  void form_left_derivatives(const std::vector<Entry>& row);
  void append_rows(const Expressions& first, const std::vector<EntryStatistics>& statistics,
                   Expressions& to, std::vector<EntryStatistics>& statistics_to);
  /// k_1_j → k_i_j.
  [[nodiscard]] ReplacementOf renaming_rows(int i) const;
  /// k_j_1 → k_j_i.
  [[nodiscard]] ReplacementOf renaming_columns(int i) const;
  [[nodiscard]] static ReplacementOf renaming(std::map<std::string, Expression> names);
  void form_right_product();
  /// The only row in which an uncertain quantity occurs, or Expansion::kNoRow.
  [[nodiscard]] int row_of(const Variable& v) const;
  [[nodiscard]] bool has_row_quantity() const;
  void form_expansion(bool at_nominal);
  /// A with uncertain quantities at their values.
  MatrixForms nominal_forms(const std::map<std::string, Expression>& values);
  /// All derivatives that are not zero, from the first row of K·A.
  void form_expansion_of(const std::vector<Entry>& row);
  void append_column(DerivativeIndex place, const Polynomial& p, const std::string& function,
                     DerivativeForms& to);
  /// ∂A[i][j] by quantities that touch row i only, and the second derivatives that go with them.
  void form_row_derivatives(int i, int j, std::vector<PolynomialDifferentiator>& by);
  Expression rewritten(const Expression& natural, const std::string& function);
  void form_row_scale();
  void form_motion();
  void collect_must_be_defined();
  void append_partial(const GiNaC::ex& e, Expressions& to);
  /// In canonical order, without repetitions, without those that are part of another.
  [[nodiscard]] static Expressions outermost(const Expressions& all);

  const Model& model_;
  const Motion& motion_;
  const FormulationOptions options_;
  const bool needs_matrix_;
  WorkMeter uncounted_;  // for what no budget counts
  Substitution substitution_;
  Rewriter rewriter_;
  MatrixForms forms_;  // of A
  Formulation result_;
};

}  // namespace regulus::inline formulation
