// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "codegen/kernel/formulation/formulator.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

/// The legs of robots with rotary motors have roots and quotients. If entries with such parts are
/// expanded and differentiated twice, they grow to millions of terms, and no bound becomes
/// narrower. In a matrix with such entries, parts of more than kMostTermsOfAPart terms stay as the
/// model writes them.
constexpr std::size_t kMostTermsOfAPart = 8;

bool has_roots_or_quotients(const Model& model, const Motion& motion, const FormingWatch* watch) {
  WorkMeter meter(WorkMeter::kNoLimit, watch, WorkStage::kSubstitution);
  Substitution substitution(model, motion, &meter);
  for (unsigned i = 0; i < model.matrix.rows(); ++i)
    for (unsigned j = 0; j < model.matrix.cols(); ++j)
      if (!substitution.apply(model.matrix(i, j)).is_total()) return true;
  return false;
}

/// Returns the options for one level of detail within a budget.
FormulationOptions with_detail(FormulationOptions options, FormDetail detail) {
  if (detail == FormDetail::kFull) return options;
  options.columns = ColumnSearch::kNone;
  options.rewriting.most_terms = std::min(options.rewriting.most_terms, kMostTermsOfAPart);
  if (detail == FormDetail::kSmallParts) return options;
  options.rewriting.most_terms = 1;
  options.rewriting.rewrite = options.determinant = false;
  options.matrix_derivatives = options.derivatives = false;
  options.expansion = ExpansionForm::kNone;
  return options;
}

Formulation formed(const Model& model, const Motion& motion, const FormulationOptions& options,
                   FormDetail detail, bool hides_parts, std::uint64_t budget,
                   const FormingWatch* watch) {
  WorkMeter meter(budget, watch);
  Formulation result =
      Formulator(model, motion, with_detail(options, detail), hides_parts, meter, watch).run();
  result.detail = detail;
  result.work = meter.spent();
  return result;
}

/// The matrix of equations depends on unknowns, which are no variables of a kernel.
void require_matrix(const Model& model) {
  if (!model.closure) return;
  throw InputError::statement(
      model.path, 0, "this needs a matrix of the pose, and the model gives equations in [closure]",
      "ask check about it, or give the robot by its legs or its matrix", "closure");
}

}  // namespace

Formulation formulate(const Model& model, const Motion& motion, const FormulationOptions& options,
                      const FormingWatch* watch) {
  require_matrix(model);
  // A determinant in closed form is always expanded, and has a budget of its own.
  if (options.determinant)
    return formed(model, motion, options, FormDetail::kFull, false, WorkMeter::kNoLimit, watch);
  FormulationOptions adapted = options;
  const bool has_parts = has_roots_or_quotients(model, motion, watch);
  if (has_parts)
    adapted.rewriting.most_terms = std::min(options.rewriting.most_terms, kMostTermsOfAPart);
  for (const FormDetail detail : {FormDetail::kFull, FormDetail::kSmallParts}) try {
      const bool hides_parts =
          has_parts && options.rewriting.rewrite && detail == FormDetail::kFull;
      return formed(model, motion, adapted, detail, hides_parts, options.forming_budget, watch);
    } catch (const OverBudget&) {
    }
  return formed(model, motion, adapted, FormDetail::kAsWritten, false, WorkMeter::kNoLimit, watch);
}

void set_shape(const Model& model, const Motion& motion, const Substitution& substitution,
               Formulation& of) {
  of.model = model.name;
  of.motion = motion.name;
  of.variables = substitution.variables();
  of.rows = static_cast<int>(model.matrix.rows());
  of.columns = static_cast<int>(model.matrix.cols());
}

Formulation formulate_shape(const Model& model, const Motion& motion) {
  Formulation result;
  set_shape(model, motion, Substitution(model, motion), result);
  result.detail = FormDetail::kAsWritten;
  return result;
}

std::string point_name(int row, int column) {
  return "k_" + std::to_string(row) + "_" + std::to_string(column);
}

}  // namespace regulus::detail
