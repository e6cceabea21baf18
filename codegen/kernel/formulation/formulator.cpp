// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/formulation/formulator.hpp"

#include <utility>

#include "codegen/kernel/columns/column_choice.hpp"
#include "codegen/kernel/formulation/typical_ranges.hpp"
#include "codegen/kernel/symbolic/determinant.hpp"

namespace regulus::detail {

namespace {

std::vector<std::string> point_names(int rows, int columns) {
  std::vector<std::string> names;
  for (int i = 1; i <= rows; ++i)
    for (int j = 1; j <= columns; ++j) names.push_back(point_name(i, j));
  return names;
}

/// Motion parameters have far wider ranges than uncertain quantities, and the search bisects them,
/// so an occurrence of one counts as many occurrences of an uncertain quantity.
RewriteOptions weighted(RewriteOptions options, const std::vector<Variable>& variables) {
  constexpr std::uint64_t kMotionWeight = 16;
  for (const Variable& v : variables)
    if (v.kind == VariableKind::kMotion) options.weights.emplace(v.name, kMotionWeight);
  return options;
}

}  // namespace

bool uses_matrix(const FormulationOptions& f) {
  return f.matrix || f.matrix_derivatives || f.left_product || f.derivatives || f.right_product ||
         f.determinant || f.expansion != ExpansionForm::kNone || f.columns != ColumnSearch::kNone;
}

Formulator::Formulator(const Model& model, const Motion& motion, const FormulationOptions& options,
                       bool hides_parts, WorkMeter& meter, const FormingWatch* watch)
    : model_(model),
      motion_(motion),
      options_(options),
      needs_matrix_(uses_matrix(options)),
      uncounted_(WorkMeter::kNoLimit, watch, WorkStage::kSubstitution),
      substitution_(model, motion, &uncounted_),
      rewriter_(
          substitution_.names(),
          point_names(static_cast<int>(model.matrix.cols()), static_cast<int>(model.matrix.rows())),
          weighted(options.rewriting, substitution_.variables()), &meter) {
  set_shape(model, motion, substitution_, result_);
  typical_ = with_typical_ranges(result_.variables);
  if (!hides_parts) return;
  RewriteOptions wide = weighted(options.rewriting, result_.variables);
  wide.most_terms = RewriteOptions().most_terms;
  wide.squares_roots = true;
  wide_.emplace(substitution_.names(), point_names(result_.columns, result_.rows), wide, &meter);
  parts_.emplace(typical_, *wide_, rewriter_);
}

Formulation Formulator::run() {
  form_matrix();
  if (parts_) hide_parts();
  if (options_.right_product && result_.rows == result_.columns) form_right_product();
  if (options_.columns != ColumnSearch::kNone && options_.rewriting.rewrite && !parts_)
    change_columns();
  if (options_.matrix_derivatives) form_matrix_derivatives();
  const bool expands = options_.expansion != ExpansionForm::kNone && !result_.variables.empty();
  const bool at_nominal =
      expands && options_.expansion == ExpansionForm::kAtNominal && has_row_quantity();
  if ((options_.left_product || options_.derivatives) && !at_nominal) form_left_product();
  if (expands) form_expansion(at_nominal);
  if (options_.determinant) form_determinant();
  form_row_scale();
  form_motion();
  if (parts_) reveal_parts();
  collect_must_be_defined();
  if (!options_.matrix) result_.matrix.clear();
  if (!options_.left_product) result_.left_product = {};
  if (!options_.counts_occurrences) result_.statistics.clear();
  return std::move(result_);
}

void Formulator::hide_parts() {
  entries_ = std::move(forms_.expanded);
  forms_.expanded.clear();
  forms_.rewritten.clear();
  for (Expression& entry : forms_.natural) {
    entry = parts_->hide(entry);
    forms_.expanded.push_back(wide_->expand(entry));
    forms_.rewritten.push_back(wide_->rewrite(entry).expression);
  }
}

PolynomialDifferentiator Formulator::differentiator(const std::string& variable) {
  return {variable, of_products().atoms(), of_products().expander(), parts_ ? &*parts_ : nullptr};
}

Rewritten Formulator::best_form(const Polynomial& p, const Expression* natural) {
  constexpr std::size_t kMostMergedTerms = 300;
  if (parts_ && p.terms().size() > kMostMergedTerms) return wide_->nested_form(p);
  return of_products().best_form(p, natural);
}

Expression Formulator::revealed(const Expression& e) { return parts_ ? parts_->reveal(e) : e; }

void Formulator::reveal_parts() {
  const auto reveal = [this](Expressions& forms) {
    for (Expression& form : forms) form = parts_->reveal(form);
  };
  for (ProductForms* forms :
       {&result_.left_product, &result_.left_derivatives, &result_.right_product})
    reveal(forms->first);
  if (!result_.expansion) return;
  ExpansionForms& x = *result_.expansion;
  for (ProductForms* forms : {&x.product, &x.first.forms, &x.second.forms}) reveal(forms->first);
  for (DerivativeForms* rows : {&x.row_first, &x.row_second}) reveal(rows->forms);
}

void Formulator::form_natural_matrix() {
  for (int i = 0; i < result_.rows; ++i)
    for (int j = 0; j < result_.columns; ++j) {
      result_.natural_matrix.push_back(
          substitution_.apply(model_.matrix(static_cast<unsigned>(i), static_cast<unsigned>(j))));
      rewriter_.atoms().spend(1 + count_operations({result_.natural_matrix.back()}));
    }
  if (!options_.scaling) return;
  result_.scaling =
      find_scaling(result_.natural_matrix, result_.columns, typical_,
                   result_.rows == result_.columns && may_have_threshold(), &uncounted_);
}

bool Formulator::may_have_threshold() const {
  return options_.threshold || !motion_.alpha.is_zero();
}

void Formulator::form_matrix() {
  form_natural_matrix();
  if (!needs_matrix_) return;
  for (int i = 0; i < result_.rows; ++i)
    for (int j = 0; j < result_.columns; ++j) {
      const Expression natural =
          result_.scaling.apply(result_.natural_matrix[index(i * result_.columns + j)], i, j);
      const Rewritten form = rewriter_.rewrite(natural);
      result_.matrix.push_back(form.expression);
      forms_.expanded.push_back(rewriter_.expand(natural));
      forms_.natural.push_back(natural);
      forms_.formed.push_back(natural);
      forms_.rewritten.push_back(form.expression);
      result_.statistics["matrix"].push_back(
          {counted(natural), counted(form.expression), form.passes});
    }
}

void Formulator::change_columns() {
  const bool second_order = options_.columns == ColumnSearch::kSecondOrder;
  BoundsSetting setting{typical_, {}, second_order};
  setting.row_of_variable = second_order
                                ? rows_of_variables()
                                : std::vector<int>(result_.variables.size(), Expansion::kNoRow);
  PolynomialMatrix A{result_.columns, forms_.expanded};
  ColumnDecision decision = choose_columns(A, rewriter_, setting);
  for (const ColumnOperation& operation : decision.kept) apply(operation, A);
  forms_.expanded = std::move(A.entries);
  for (const AppliedOperation& operation : decision.trials.kept) change_column(operation);
  result_.column_trials = std::move(decision.trials);
}

void Formulator::change_column(const AppliedOperation& operation) {
  for (int i = 0; i < result_.rows; ++i) {
    const std::size_t target = index(i * result_.columns + operation.target);
    Expression& formed = forms_.formed[target];
    formed = formed +
             operation.multiplier * forms_.formed[index(i * result_.columns + operation.source)];
    const Rewritten form = rewriter_.best_form(forms_.expanded[target]);
    forms_.rewritten[target] = result_.matrix[target] = form.expression;
    EntryStatistics& statistics = result_.statistics["matrix"][target];
    statistics.rewritten = counted(form.expression);
    statistics.passes = form.passes;
  }
}

void Formulator::form_matrix_derivatives() {
  for (const Variable& v : result_.variables) {
    PolynomialDifferentiator by(v.name, rewriter_.atoms(), rewriter_.expander());
    for (const Polynomial& entry : parts_ ? entries_ : forms_.expanded) {
      const Rewritten form = rewriter_.best_form(by.derivative(entry));
      result_.matrix_derivatives.push_back(form.expression);
      result_.statistics["matrix_derivatives"].push_back(
          {{}, counted(form.expression), form.passes});
    }
  }
}

void Formulator::form_determinant() {
  if (result_.rows != result_.columns)
    throw ClosedFormError("the matrix is " + std::to_string(result_.rows) + "×" +
                          std::to_string(result_.columns) +
                          "; only a square one has a determinant");
  DeterminantBudget budget(options_.determinant_budget);
  const Polynomial p = determinant(forms_.expanded, result_.columns, rewriter_.atoms(), budget);
  result_.determinant = {nested(p, "determinant")};
  for (const Variable& v : result_.variables) {
    budget.spend(p.terms().size());
    PolynomialDifferentiator by(v.name, rewriter_.atoms(), rewriter_.expander());
    const Polynomial slope = without_squared_sines(by.derivative(p), rewriter_.atoms());
    result_.determinant_derivatives.push_back(nested(slope, "determinant_derivatives"));
  }
  result_.determinant_terms = budget.spent();
}

Occurrences Formulator::counted(const Expression& e) const {
  return options_.counts_occurrences ? count_occurrences(e) : Occurrences();
}

Expression Formulator::nested(const Polynomial& p, const std::string& function) {
  Rewritten form = rewriter_.nested_form(p);
  result_.statistics[function].push_back({{}, counted(form.expression), form.passes});
  return form.expression;
}

}  // namespace regulus::detail
