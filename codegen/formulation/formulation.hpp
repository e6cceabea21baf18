// SPDX-License-Identifier: GPL-3.0-or-later
// The symbolic stage: from a model and one of its motions to the rewritten expressions of every
// kernel function, and on to a Module.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "codegen/columns/column_trials.hpp"
#include "codegen/formulation/scaling.hpp"
#include "codegen/model/model.hpp"
#include "codegen/program/budgets.hpp"
#include "codegen/program/module.hpp"
#include "codegen/program/work_meter.hpp"
#include "codegen/symbolic/expression.hpp"
#include "codegen/symbolic/measure.hpp"
#include "codegen/symbolic/rewrite.hpp"
#include "codegen/symbolic/variable.hpp"

namespace regulus::inline formulation {

/// Whether Taylor's expansion of K·A is formed, and at which values of the uncertain quantities
/// that touch one row only.
enum class ExpansionForm {
  kNone,
  kAtNominal,  ///< at their nominal values: for boxes that are never split in them
  kAtBox,      ///< at the midpoints of a box
};

/// Whether A·V may take the place of A where that makes the bounds of K·A narrower, V a product of
/// column operations of determinant 1; and which bounds decide.
enum class ColumnSearch {
  kNone,
  kFirstOrder,   ///< natural and mean-value bounds
  kSecondOrder,  ///< those of the expansion at nominal values
};

/// How much was made of a model's expressions within the budget.
enum class FormDetail {
  kFull,
  kSmallParts,  ///< parts of more than eight terms stay as the model writes them
  kAsWritten,   ///< all of them do, and there are no derivatives
};

/// Which functions to form.
struct FormulationOptions {
  bool matrix = true;
  bool matrix_derivatives = true;
  bool left_product = true;
  bool derivatives = true;
  bool right_product = true;
  bool determinant = false;  ///< in closed form, and its derivatives; of square matrices only
  std::uint64_t determinant_budget = kDeterminantBudget;  ///< see TermBudget
  /// With an expansion at nominal values left product and derivatives are left out if any quantity
  /// touches one row only: they would be blind to it, and wide.
  ExpansionForm expansion = ExpansionForm::kNone;
  bool rows = true;  ///< false: the expansion treats every quantity as if it touched several rows
  ColumnSearch columns = ColumnSearch::kNone;
  bool scaling = true;  ///< multiply rows and columns by powers of two where scales are far apart
  /// Whether the kernel may be searched with a threshold where the motion has none. The row scale
  /// then makes up for the scaling of the determinant.
  bool threshold = true;
  RewriteOptions rewriting;
  std::uint64_t forming_budget = kFormingBudget;  ///< not of a determinant, which has its own
};

/// Derivatives that are not zero everywhere.
struct DerivativeForms {
  std::vector<DerivativeIndex> places;
  std::vector<Expression> forms;
};

/// See regulus_expansion. `product` and `first` are empty when left_product and left_derivatives
/// serve as such.
struct ExpansionForms {
  std::vector<int> row_of_variable;   ///< or Expansion::kNoRow
  std::vector<int> ball_of_variable;  ///< or −1; empty if there are no balls
  std::vector<Expression> nominal;    ///< per variable, constants; empty for kAtBox
  std::vector<Expression> product;
  DerivativeForms first, second, row_first, row_second;
};

/// How one entry came to its form.
struct EntryStatistics {
  Occurrences natural;  ///< of the entry as the model writes it
  Occurrences rewritten;
  std::string passes;
};

/// Everything a kernel computes, after substitution of the motion variety and rewriting.
/// K's entries are the points k_1_1 … (n×m), row-major.
///
/// With column operations A is the model's matrix times V in all functions of the kernel, K
/// included, as it is found from `matrix`. det V = 1 wherever A is defined, so that determinants,
/// their signs, ranks, row scales and dependencies between rows are the model's own. What is not,
/// null vectors on the right and the entries themselves, is to be taken from `natural_matrix`, in
/// which V has no part. The right product is formed of the model's matrix.
///
/// With `scaling` A is RAC in all functions, the right product included. Ranks and the signs of
/// determinants are the model's own; determinants are 2^e times those of the model, and with α > 0
/// the row scale has the factor 2^-e, so that det J⁻¹ is the model's own.
struct Formulation {
  std::string model;
  std::string motion;
  std::vector<Variable> variables;
  int rows = 0;
  int columns = 0;
  std::vector<Expression> matrix;              ///< A, m·n, row-major
  std::vector<Expression> matrix_derivatives;  ///< ∂_kA, variables·m·n
  std::vector<Expression> left_product;        ///< K·A, n·n
  std::vector<Expression> left_derivatives;    ///< ∂_k(K·A), variables·n·n
  std::vector<Expression> right_product;       ///< A·K, m·m; empty unless m = n
  std::optional<ExpansionForms> expansion;
  std::vector<Expression> row_scale;  ///< one entry, the product of the row scales; empty if none
  std::vector<Expression> constraints;
  std::vector<Expression> pose;
  std::vector<Expression> determinant;              ///< one entry, det A; empty unless asked for
  std::vector<Expression> determinant_derivatives;  ///< ∂_k det A, one for each variable
  std::uint64_t determinant_terms = 0;              ///< what TermBudget counted
  FormDetail detail = FormDetail::kFull;
  std::uint64_t work = 0;  ///< what these forms took, without those that were given up

  /// Expressions without which a value of the functions means nothing: roots, denominators … of the
  /// model and the motion as written, which rewriting or differentiation may have removed. `lower`
  /// makes every function undefined where one of these is.
  std::vector<Expression> must_be_defined;
  /// The same for constraints and pose: of the motion alone.
  std::vector<Expression> motion_must_be_defined;

  std::optional<ColumnTrials> column_trials;  ///< if column operations were asked for

  std::vector<Expression> natural_matrix;     ///< A as the model writes it, without `scaling`
  MatrixScaling scaling;                      ///< of the rows and columns of A
  std::vector<Expression> natural_row_scale;  ///< per row, as written; empty if there are none
  /// Per entry, by the name of the kernel function. Derivatives have no natural counts.
  std::map<std::string, std::vector<EntryStatistics>> statistics;
};

/// The name of an entry of K, from 1: k_1_2.
[[nodiscard]] std::string point_name(int row, int column);

/// Throws InputError when the model and the motion do not fit together, ClosedFormError
/// (determinant.hpp) when a determinant is asked for and cannot be had, FormingStopped when `watch`
/// says so.
///
/// Ensures   the same model, motion and options give the same forms, however long that takes: what
///           exceeds the budget is formed again with less detail.
[[nodiscard]] Formulation formulate(const Model& model, const Motion& motion,
                                    const FormulationOptions& options = {},
                                    const FormingWatch* watch = nullptr);

/// The variables and sizes without any function, for reports on a question that was given up.
[[nodiscard]] Formulation formulate_shape(const Model& model, const Motion& motion);

/// A program of expressions over the formulation's variables, which need not be functions of the
/// kernel.
[[nodiscard]] Program lower_outputs(const Formulation& formulation,
                                    const std::vector<Expression>& outputs);

/// The program of every function, in canonical order. Throws FormingStopped when `watch` says so.
[[nodiscard]] Module lower(const Formulation& formulation, const FormingWatch* watch = nullptr);

/// A kernel of the formulation's variables and sizes whose functions are undefined at every point:
/// nothing can be proved with it, neither that a matrix is regular nor that it is singular.
[[nodiscard]] Module undefined_kernel(const Formulation& shape, int constraints,
                                      int pose_parameters);

}  // namespace regulus::inline formulation
