// SPDX-License-Identifier: GPL-3.0-or-later
// The symbolic stage: from a model and one of its motions to the rewritten expressions of every
// kernel function, and on to a Module.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "codegen/kernel/columns/column_trials.hpp"
#include "codegen/kernel/formulation/scaling.hpp"
#include "codegen/kernel/program/budgets.hpp"
#include "codegen/kernel/program/module.hpp"
#include "codegen/kernel/symbolic/expression.hpp"
#include "codegen/kernel/symbolic/measure.hpp"
#include "codegen/kernel/symbolic/rewrite.hpp"
#include "codegen/kernel/symbolic/variable.hpp"
#include "codegen/model/model.hpp"
#include "codegen/support/work_meter.hpp"

namespace regulus::detail {

/// Selects whether Taylor's expansion of K·A is formed, and at which values of the uncertain
/// quantities that touch only one row.
enum class ExpansionForm {
  kNone,
  kAtNominal,  ///< at their nominal values: for boxes that are never split along them
  kAtBox,      ///< at the midpoints of a box
};

/// Selects whether A·V may replace A if this makes the bounds of K·A narrower (V is a product of
/// column operations of determinant 1), and which bounds decide.
enum class ColumnSearch {
  kNone,
  kFirstOrder,   ///< natural and mean-value bounds
  kSecondOrder,  ///< those of the expansion at nominal values
};

/// The detail of the forms that the budget allowed.
enum class FormDetail {
  kFull,
  kSmallParts,  ///< parts of more than eight terms stay as the model writes them
  kAsWritten,   ///< all parts do, and there are no derivatives
};

/// Selects the functions to form.
struct FormulationOptions {
  bool matrix = true;
  bool matrix_derivatives = true;
  bool left_product = true;
  bool derivatives = true;
  bool right_product = true;
  bool determinant = false;  ///< in closed form, and its derivatives; of square matrices only
  std::uint64_t determinant_budget = kDeterminantBudget;  ///< see DeterminantBudget
  /// With an expansion at nominal values, the left product and its derivatives are left out if any
  /// quantity touches only one row: they could not use this, and would be wide.
  ExpansionForm expansion = ExpansionForm::kNone;
  bool rows = true;  ///< false: the expansion treats every quantity as if it touched several rows
  ColumnSearch columns = ColumnSearch::kNone;
  bool scaling = true;  ///< multiply rows and columns by powers of two if scales are far apart
  /// True if the kernel may be searched with a threshold although the motion has none. The row
  /// scale then compensates the scaling of the determinant.
  bool threshold = true;
  bool counts_occurrences = true;  ///< false: no EntryStatistics, which are for people
  RewriteOptions rewriting;
  std::uint64_t forming_budget = kFormingBudget;  ///< not of a determinant, which has its own
};

/// Derivatives that are not zero everywhere.
struct DerivativeForms {
  std::vector<DerivativeIndex> places;
  std::vector<Expression> forms;
};

/// Forms of a product with K, or of its derivatives. The rows of K·A differ only in the entries of
/// K, as do the columns of A·K, so only the first row or column is kept. Outputs are blocks: each
/// block of the first row is followed by that block of the other rows.
struct ProductForms {
  std::vector<Expression> first;
  std::size_t block = 1;
  [[nodiscard]] bool empty() const noexcept { return first.empty(); }
};

/// Derivatives of K·A that are not zero everywhere.
struct ProductDerivatives {
  std::vector<DerivativeIndex> places;  ///< of all outputs
  ProductForms forms;
};

/// See regulus_expansion. `product` and `first` are empty if left_product and left_derivatives
/// serve as such.
struct ExpansionForms {
  std::vector<int> row_of_variable;   ///< or Expansion::kNoRow
  std::vector<int> ball_of_variable;  ///< or −1; empty if there are no balls
  std::vector<Expression> nominal;    ///< per variable, constants; empty for kAtBox
  ProductForms product;
  ProductDerivatives first, second;
  DerivativeForms row_first, row_second;
};

/// The occurrences and passes that gave one entry its form.
struct EntryStatistics {
  Occurrences natural;  ///< of the entry as the model writes it
  Occurrences rewritten;
  std::string passes;
};

/// Everything a kernel computes, after substitution of the motion variety and rewriting.
/// K's entries are the points k_1_1 … (n×m), row-major.
///
/// With column operations A is the model's matrix times V in all functions of the kernel. K follows
/// it, because K is computed from `matrix`. det V = 1 wherever A is defined, so determinants, their
/// signs, ranks, row scales and dependencies between rows are those of the model. Null vectors on
/// the right and the entries themselves are not; take them from `natural_matrix`, which does not
/// contain V. The right product is formed from the model's matrix.
///
/// With `scaling` A is RAC in all functions, including the right product. Ranks and the signs of
/// determinants are those of the model. Determinants are 2^e times those of the model; with α > 0
/// the row scale has the factor 2^-e, so that det J⁻¹ is that of the model.
struct Formulation {
  std::string model;
  std::string motion;
  std::vector<Variable> variables;
  int rows = 0;
  int columns = 0;
  std::vector<Expression> matrix;              ///< A, m·n, row-major
  std::vector<Expression> matrix_derivatives;  ///< ∂_kA, variables·m·n
  ProductForms left_product;                   ///< K·A, n·n
  ProductForms left_derivatives;               ///< ∂_k(K·A), variables·n·n
  ProductForms right_product;                  ///< A·K, m·m; empty unless m = n
  std::optional<ExpansionForms> expansion;
  std::vector<Expression> row_scale;  ///< one entry, the product of the row scales; empty if none
  std::vector<Expression> constraints;
  std::vector<Expression> pose;
  std::vector<Expression> determinant;              ///< one entry, det A; empty unless requested
  std::vector<Expression> determinant_derivatives;  ///< ∂_k det A, one for each variable
  std::uint64_t determinant_terms = 0;              ///< the count of DeterminantBudget
  FormDetail detail = FormDetail::kFull;
  std::uint64_t work = 0;  ///< for these forms, without abandoned ones

  /// Expressions that must be defined for a value of the functions to have a meaning: roots,
  /// denominators … of the model and the motion as written, which rewriting or differentiation may
  /// have removed. `lower` makes every function undefined where one of them is.
  std::vector<Expression> must_be_defined;
  /// The same for constraints and pose; only of the motion.
  std::vector<Expression> motion_must_be_defined;

  std::optional<ColumnTrials> column_trials;  ///< if column operations were requested

  std::vector<Expression> natural_matrix;     ///< A as the model writes it, without `scaling`
  MatrixScaling scaling;                      ///< of the rows and columns of A
  std::vector<Expression> natural_row_scale;  ///< per row, as written; empty if there are none
  /// Per entry, by the name of the kernel function. Derivatives have no natural counts.
  std::map<std::string, std::vector<EntryStatistics>> statistics;
};

/// Returns the name of an entry of K, from 1: k_1_2.
[[nodiscard]] std::string point_name(int row, int column);

/// Returns e of the first row of K·A as it stands in another one, from 1.
[[nodiscard]] Expression in_row(const Expression& e, int row);
/// Returns e of the first column of A·K as it stands in another one, from 1.
[[nodiscard]] Expression in_column(const Expression& e, int column);

/// Throws InputError if the model and the motion do not fit together, ClosedFormError
/// (determinant.hpp) if a requested determinant has no closed form, FormingStopped if `watch` stops
/// it.
///
/// Ensures   the same model, motion and options give the same forms, however long that takes: a
///           model that exceeds the budget is formed again with less detail.
[[nodiscard]] Formulation formulate(const Model& model, const Motion& motion,
                                    const FormulationOptions& options = {},
                                    const FormingWatch* watch = nullptr);

/// Returns the variables and sizes without any function, for reports on an abandoned question.
[[nodiscard]] Formulation formulate_shape(const Model& model, const Motion& motion);

/// Returns a program of any expressions over the formulation's variables; they need not be
/// functions of the kernel.
[[nodiscard]] Program lower_outputs(const Formulation& formulation,
                                    const std::vector<Expression>& outputs);

/// Returns the program of every function, in canonical order. Throws FormingStopped if `watch`
/// stops it.
[[nodiscard]] Module lower(const Formulation& formulation, const FormingWatch* watch = nullptr);

/// Returns a kernel of the formulation's variables and sizes whose functions are undefined at every
/// point. It proves nothing, neither that a matrix is regular nor that it is singular.
[[nodiscard]] Module undefined_kernel(const Formulation& shape, int constraints,
                                      int pose_parameters);

}  // namespace regulus::detail
