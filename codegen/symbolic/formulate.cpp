// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>
#include <unordered_set>
#include <utility>

#include "regulus/codegen/symbolic/column_choice.hpp"
#include "regulus/codegen/symbolic/derivative.hpp"
#include "regulus/codegen/symbolic/determinant.hpp"
#include "regulus/codegen/symbolic/evaluate.hpp"
#include "regulus/codegen/symbolic/formulation.hpp"
#include "regulus/codegen/symbolic/from_ginac.hpp"
#include "regulus/codegen/symbolic/substitution.hpp"

namespace regulus::codegen {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// Whether any function is asked for that is made of the entries of A in other forms than the
/// model's own.
bool uses_matrix(const FormulationOptions& f) {
  return f.matrix || f.matrix_derivatives || f.left_product || f.derivatives || f.right_product ||
         f.determinant || f.expansion != ExpansionForm::kNone || f.columns != ColumnSearch::kNone;
}

std::vector<std::string> point_names(int rows, int columns) {
  std::vector<std::string> names;
  for (int i = 1; i <= rows; ++i)
    for (int j = 1; j <= columns; ++j) names.push_back(point_name(i, j));
  return names;
}

/// The legs of robots with rotary motors are roots and quotients. Multiplied out and differentiated
/// twice, entries made of them grow to millions of terms, and no bound becomes narrower by that. In
/// a matrix that has some, parts of more than kMostTermsOfAPart stay as the model writes them.
constexpr std::size_t kMostTermsOfAPart = 8;

bool has_roots_or_quotients(const Model& model, const Motion& motion) {
  Substitution substitution(model, motion);
  for (unsigned i = 0; i < model.matrix.rows(); ++i)
    for (unsigned j = 0; j < model.matrix.cols(); ++j)
      if (!substitution.apply(model.matrix(i, j)).is_total()) return true;
  return false;
}

/// Motion parameters range over far more than the uncertain quantities do, and are what is
/// bisected: an occurrence of one is worth many of theirs.
RewriteOptions weighted(RewriteOptions options, const std::vector<Variable>& variables) {
  constexpr std::uint64_t kMotionWeight = 16;
  for (const Variable& v : variables)
    if (v.kind == VariableKind::kMotion) options.weights.emplace(v.name, kMotionWeight);
  return options;
}

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

class Formulator {
 public:
  Formulator(const Model& model, const Motion& motion, const FormulationOptions& options,
             WorkMeter& meter)
      : model_(model),
        motion_(motion),
        options_(options),
        substitution_(model, motion),
        rewriter_(substitution_.names(),
                  point_names(static_cast<int>(model.matrix.cols()),
                              static_cast<int>(model.matrix.rows())),
                  weighted(options.rewriting, substitution_.variables()), &meter) {
    result_.model = model.name;
    result_.motion = motion.name;
    result_.variables = substitution_.variables();
    result_.rows = static_cast<int>(model.matrix.rows());
    result_.columns = static_cast<int>(model.matrix.cols());
  }

  Formulation run() {
    form_matrix();
    if (options_.right_product && result_.rows == result_.columns) form_right_product();
    if (options_.columns != ColumnSearch::kNone && options_.rewriting.rewrite) change_columns();
    if (options_.matrix_derivatives) form_matrix_derivatives();
    const bool expands = options_.expansion != ExpansionForm::kNone && !result_.variables.empty();
    const bool at_nominal =
        expands && options_.expansion == ExpansionForm::kAtNominal && has_row_quantity();
    if ((options_.left_product || options_.derivatives) && !at_nominal) form_left_product();
    if (expands) form_expansion(at_nominal);
    if (options_.determinant) form_determinant();
    form_row_scale();
    form_motion();
    collect_must_be_defined();
    if (!options_.matrix) result_.matrix.clear();
    if (!options_.left_product) result_.left_product.clear();
    return std::move(result_);
  }

 private:
  void form_natural_matrix() {
    for (int i = 0; i < result_.rows; ++i)
      for (int j = 0; j < result_.columns; ++j) {
        result_.natural_matrix.push_back(
            substitution_.apply(model_.matrix(static_cast<unsigned>(i), static_cast<unsigned>(j))));
        rewriter_.atoms().spend(1 + count_operations({result_.natural_matrix.back()}));
      }
    if (!options_.scaling) return;
    result_.scaling = find_scaling(result_.natural_matrix, result_.columns, result_.variables,
                                   result_.rows == result_.columns && may_have_threshold());
  }

  bool may_have_threshold() const { return options_.threshold || !motion_.alpha.is_zero(); }

  void form_matrix() {
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
            {count_occurrences(natural), count_occurrences(form.expression), form.passes});
      }
  }

  /// From A to A·V where that has the narrower bounds.
  void change_columns() {
    const bool second_order = options_.columns == ColumnSearch::kSecondOrder;
    BoundsSetting setting{result_.variables, {}, second_order};
    for (const Variable& v : result_.variables)
      setting.row_of_variable.push_back(second_order ? row_of(v) : Expansion::kNoRow);
    PolynomialMatrix A{result_.columns, forms_.expanded};
    ColumnDecision decision = choose_columns(A, rewriter_, setting);
    for (const ColumnOperation& operation : decision.kept) apply(operation, A);
    forms_.expanded = std::move(A.entries);
    for (const AppliedOperation& operation : decision.trials.kept) change_column(operation);
    result_.column_trials = std::move(decision.trials);
  }

  void change_column(const AppliedOperation& operation) {
    for (int i = 0; i < result_.rows; ++i) {
      const std::size_t target = index(i * result_.columns + operation.target);
      Expression& formed = forms_.formed[target];
      formed = formed +
               operation.multiplier * forms_.formed[index(i * result_.columns + operation.source)];
      const Rewritten form = rewriter_.best_form(forms_.expanded[target]);
      forms_.rewritten[target] = result_.matrix[target] = form.expression;
      EntryStatistics& statistics = result_.statistics["matrix"][target];
      statistics.rewritten = count_occurrences(form.expression);
      statistics.passes = form.passes;
    }
  }

  void form_matrix_derivatives() {
    for (const Variable& v : result_.variables) {
      PolynomialDifferentiator by(v.name, rewriter_.atoms(), rewriter_.expander());
      for (const Polynomial& entry : forms_.expanded) {
        const Rewritten form = rewriter_.best_form(by.derivative(entry));
        result_.matrix_derivatives.push_back(form.expression);
        result_.statistics["matrix_derivatives"].push_back(
            {{}, count_occurrences(form.expression), form.passes});
      }
    }
  }

  /// Σ_j points[j]·A[entries[j]].
  Entry combine(const MatrixForms& A, const std::vector<std::string>& points,
                const std::vector<std::size_t>& entries) {
    std::vector<PolynomialTerm> terms;
    Expressions natural, rewritten;
    for (std::size_t j = 0; j < points.size(); ++j) {
      const Expression k = point(points[j]);
      const AtomProduct atom(1, rewriter_.atoms().coefficient_atom(k));
      for (const PolynomialTerm& term : A.expanded[entries[j]].terms())
        terms.push_back(
            {Monomial{term.monomial.variables, multiply(term.monomial.coefficients, atom)},
             term.factor});
      rewriter_.atoms().spend(1 + A.expanded[entries[j]].terms().size());
      natural.push_back(k * A.natural[entries[j]]);
      rewritten.push_back(k * A.rewritten[entries[j]]);
    }
    return {Polynomial(std::move(terms)), sum(std::move(natural)), sum(std::move(rewritten))};
  }

  /// The first row of K·A. Rows differ in the names of K's entries alone.
  std::vector<Entry> first_row(const MatrixForms& A) {
    std::vector<Entry> row;
    for (int c = 0; c < result_.columns; ++c) {
      std::vector<std::string> points;
      std::vector<std::size_t> entries;
      for (int j = 0; j < result_.rows; ++j) {
        points.push_back(point_name(1, j + 1));
        entries.push_back(index(j * result_.columns + c));
      }
      row.push_back(combine(A, points, entries));
    }
    return row;
  }

  void append_best_forms(const std::vector<Entry>& row, const std::string& function,
                         Expressions& to) {
    Expressions forms;
    std::vector<EntryStatistics> statistics;
    for (const Entry& entry : row) {
      const Rewritten form = rewriter_.best_form(entry.polynomial, &entry.rewritten);
      forms.push_back(form.expression);
      statistics.push_back(
          {count_occurrences(entry.natural), count_occurrences(form.expression), form.passes});
    }
    append_rows(forms, statistics, to, result_.statistics[function]);
  }

  void form_left_product() {
    const std::vector<Entry> row = first_row(forms_);
    append_best_forms(row, "left_product", result_.left_product);
    if (options_.derivatives) form_left_derivatives(row);
  }

  void form_left_derivatives(const std::vector<Entry>& row) {
    for (const Variable& v : result_.variables) {
      PolynomialDifferentiator by(v.name, rewriter_.atoms(), rewriter_.expander());
      Expressions forms;
      std::vector<EntryStatistics> statistics;
      for (const Entry& entry : row) {
        const Rewritten form = rewriter_.best_form(by.derivative(entry.polynomial));
        forms.push_back(form.expression);
        statistics.push_back({{}, count_occurrences(form.expression), form.passes});
      }
      append_rows(forms, statistics, result_.left_derivatives,
                  result_.statistics["left_derivatives"]);
    }
  }

  void append_rows(const Expressions& first, const std::vector<EntryStatistics>& statistics,
                   Expressions& to, std::vector<EntryStatistics>& statistics_to) {
    for (int i = 1; i <= result_.columns; ++i) {
      const Expressions row = i == 1 ? first : substitute(first, renaming_rows(i));
      to.insert(to.end(), row.begin(), row.end());
      statistics_to.insert(statistics_to.end(), statistics.begin(), statistics.end());
    }
  }

  /// k_1_j → k_i_j.
  ReplacementOf renaming_rows(int i) const {
    std::map<std::string, Expression> names;
    for (int j = 1; j <= result_.rows; ++j)
      names.emplace(point_name(1, j), point(point_name(i, j)));
    return renaming(std::move(names));
  }

  /// k_j_1 → k_j_i.
  ReplacementOf renaming_columns(int i) const {
    std::map<std::string, Expression> names;
    for (int j = 1; j <= result_.columns; ++j)
      names.emplace(point_name(j, 1), point(point_name(j, i)));
    return renaming(std::move(names));
  }

  static ReplacementOf renaming(std::map<std::string, Expression> names) {
    return [names = std::move(names)](const Expression& e) -> std::optional<Expression> {
      if (e.kind() != Kind::kPoint) return std::nullopt;
      return names.at(e.name());
    };
  }

  void form_right_product() {
    std::vector<EntryStatistics>& statistics = result_.statistics["right_product"];
    for (int r = 0; r < result_.rows; ++r) {
      std::vector<std::string> points;
      std::vector<std::size_t> entries;
      for (int j = 0; j < result_.columns; ++j) {
        points.push_back(point_name(j + 1, 1));
        entries.push_back(index(r * result_.columns + j));
      }
      const Entry entry = combine(forms_, points, entries);
      const Rewritten form = rewriter_.best_form(entry.polynomial, &entry.rewritten);
      const EntryStatistics of_entry = {count_occurrences(entry.natural),
                                        count_occurrences(form.expression), form.passes};
      for (int c = 1; c <= result_.rows; ++c) {
        result_.right_product.push_back(c == 1 ? form.expression
                                               : substitute(form.expression, renaming_columns(c)));
        statistics.push_back(of_entry);
      }
    }
  }

  /// det A over the motion: the entries of a rotation are multiplied out in sines and cosines,
  /// which leaves fewer terms than taking them as indeterminates would, since their relations are
  /// used.
  void form_determinant() {
    if (result_.rows != result_.columns)
      throw ClosedFormError("the matrix is " + std::to_string(result_.rows) + "×" +
                            std::to_string(result_.columns) +
                            "; only a square one has a determinant");
    TermBudget budget(options_.determinant_budget);
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

  Expression nested(const Polynomial& p, const std::string& function) {
    Rewritten form = rewriter_.nested_form(p);
    result_.statistics[function].push_back({{}, count_occurrences(form.expression), form.passes});
    return form.expression;
  }

  /// The only row in which an uncertain quantity occurs, or Expansion::kNoRow.
  int row_of(const Variable& v) const {
    if (v.kind == VariableKind::kMotion || !options_.rows) return Expansion::kNoRow;
    std::set<int> rows;
    for (std::size_t e = 0; e < forms_.rewritten.size(); ++e)
      if (count_occurrences(forms_.rewritten[e]).count(v.name) != 0)
        rows.insert(static_cast<int>(e) / result_.columns);
    return rows.size() == 1 ? *rows.begin() : Expansion::kNoRow;
  }

  bool has_row_quantity() const {
    return std::any_of(result_.variables.begin(), result_.variables.end(),
                       [this](const Variable& v) { return row_of(v) != Expansion::kNoRow; });
  }

  void form_expansion(bool at_nominal) {
    ExpansionForms& x = result_.expansion.emplace();
    for (const Variable& v : result_.variables) x.row_of_variable.push_back(row_of(v));
    if (!at_nominal) return form_expansion_of(first_row(forms_));
    const auto in_ball = [](const Variable& v) { return v.ball >= 0; };
    if (std::any_of(result_.variables.begin(), result_.variables.end(), in_ball))
      for (const Variable& v : result_.variables) x.ball_of_variable.push_back(v.ball);
    std::map<std::string, Expression> values;
    const SymbolMeaning no_symbols;
    for (std::size_t v = 0; v < result_.variables.size(); ++v) {
      const Variable& variable = result_.variables[v];
      const bool fixed = x.row_of_variable[v] != Expansion::kNoRow;
      x.nominal.push_back(
          fixed ? GinacReader(no_symbols).read((variable.range.lo + variable.range.hi) / 2)
                : Expression(0));
      if (fixed) values.emplace(variable.name, x.nominal.back());
    }
    const std::vector<Entry> row = first_row(nominal_forms(values));
    append_best_forms(row, "nominal_product", x.product);
    form_expansion_of(row);
  }

  /// A with uncertain quantities at their values.
  MatrixForms nominal_forms(const std::map<std::string, Expression>& values) {
    const ReplacementOf value_of = [&](const Expression& e) -> std::optional<Expression> {
      if (e.kind() != Kind::kVariable) return std::nullopt;
      const auto found = values.find(e.name());
      return found == values.end() ? std::nullopt : std::optional(found->second);
    };
    MatrixForms A;
    A.natural = substitute(forms_.natural, value_of);
    A.formed = substitute(forms_.formed, value_of);
    for (const Expression& formed : A.formed) {
      A.expanded.push_back(rewriter_.expand(formed));
      A.rewritten.push_back(rewriter_.rewrite(formed).expression);
    }
    return A;
  }

  /// All derivatives that are not zero, from the first row of K·A.
  void form_expansion_of(const std::vector<Entry>& row) {
    ExpansionForms& x = *result_.expansion;
    std::vector<PolynomialDifferentiator> by;
    for (const Variable& v : result_.variables)
      by.emplace_back(v.name, rewriter_.atoms(), rewriter_.expander());
    const auto touches_one_row = [&](std::size_t v) {
      return x.row_of_variable[v] != Expansion::kNoRow;
    };
    for (std::size_t p = 0; p < by.size(); ++p) {
      if (touches_one_row(p)) continue;
      for (int c = 0; c < result_.columns; ++c) {
        const Polynomial first = by[p].derivative(row[index(c)].polynomial);
        if (!x.product.empty())
          append_column({0, c, static_cast<int>(p)}, first, "nominal_first", x.first);
        for (std::size_t q = p; q < by.size(); ++q)
          if (!touches_one_row(q))
            append_column({0, c, static_cast<int>(p), static_cast<int>(q)}, by[q].derivative(first),
                          "expansion_second", x.second);
      }
    }
    for (int i = 0; i < result_.rows; ++i)
      for (int j = 0; j < result_.columns; ++j) form_row_derivatives(i, j, by);
  }

  void append_column(DerivativeIndex place, const Polynomial& p, const std::string& function,
                     DerivativeForms& to) {
    if (p.is_zero()) return;
    const Rewritten form = rewriter_.nested_form(p);
    append_rows({form.expression}, {{{}, count_occurrences(form.expression), form.passes}},
                to.forms, result_.statistics[function]);
    for (place.row = 0; place.row < result_.columns; ++place.row) to.places.push_back(place);
  }

  /// ∂A[i][j] by quantities that touch row i only, and the second derivatives that go with them.
  void form_row_derivatives(int i, int j, std::vector<PolynomialDifferentiator>& by) {
    ExpansionForms& x = *result_.expansion;
    const Polynomial& entry = forms_.expanded[index(i * result_.columns + j)];
    const auto append = [&](const DerivativeIndex& place, const Polynomial& p,
                            const std::string& function, DerivativeForms& to) {
      if (p.is_zero()) return;
      const Rewritten form = rewriter_.quick_form(p);
      to.places.push_back(place);
      to.forms.push_back(form.expression);
      result_.statistics[function].push_back({{}, count_occurrences(form.expression), form.passes});
    };
    for (std::size_t k = 0; k < by.size(); ++k) {
      if (x.row_of_variable[k] != i) continue;
      const int variable = static_cast<int>(k);
      const Polynomial first = by[k].derivative(entry);
      append({i, j, variable}, first, "row_first", x.row_first);
      for (std::size_t q = 0; q < by.size(); ++q) {
        const bool same_row = x.row_of_variable[q] == i;
        if (same_row && q < k) continue;  // found from the other
        const int other = static_cast<int>(q);
        append({i, j, std::min(variable, other), std::max(variable, other)},
               by[q].derivative(first), "row_second", x.row_second);
      }
    }
  }

  Expression rewritten(const Expression& natural, const std::string& function) {
    Rewritten form = rewriter_.rewrite(natural);
    result_.statistics[function].push_back(
        {count_occurrences(natural), count_occurrences(form.expression), form.passes});
    return form.expression;
  }

  void form_row_scale() {
    for (const GiNaC::ex& scale : model_.row_scale)
      result_.natural_row_scale.push_back(substitution_.apply(scale));
    Expressions factors = result_.natural_row_scale;
    const bool square = result_.rows == result_.columns;
    const int exponent = square ? result_.scaling.determinant_exponent() : 0;
    if (exponent != 0 && may_have_threshold()) factors.push_back(power_of_two(-exponent));
    if (factors.empty()) return;
    result_.row_scale = {rewritten(product(std::move(factors)), "row_scale")};
  }

  void form_motion() {
    // A constraint cuts the variety of commanded poses; control errors come on top of those.
    for (const GiNaC::ex& constraint : motion_.constraints)
      result_.constraints.push_back(
          rewritten(substitution_.apply_commanded(constraint), "constraint"));
    for (const PoseParameter& p : model_.pose)
      result_.pose.push_back(rewritten(substitution_.apply(p.symbol), "pose"));
  }

  void collect_must_be_defined() {
    Expressions of_motion, all;
    for (const GiNaC::ex& e : motion_.must_be_defined) append_partial(e, of_motion);
    for (const GiNaC::ex& e : motion_.pose) append_partial(e, of_motion);
    all = of_motion;
    for (const GiNaC::ex& e : model_.must_be_defined) append_partial(e, all);
    for (unsigned i = 0; i < model_.matrix.rows(); ++i)
      for (unsigned j = 0; j < model_.matrix.cols(); ++j) append_partial(model_.matrix(i, j), all);
    result_.motion_must_be_defined = outermost(of_motion);
    result_.must_be_defined = outermost(all);
  }

  void append_partial(const GiNaC::ex& e, Expressions& to) {
    for (const Expression& partial : substitution_.partial_operations(e)) {
      Expression form = rewriter_.with_rewritten_arguments(partial);
      if (!form.is_total()) to.push_back(std::move(form));
    }
  }

  /// In canonical order, without repetitions, without those that are part of another.
  static Expressions outermost(const Expressions& all) {
    std::unordered_set<Expression, ExpressionHash> inner;
    for (const Expression& e : all)
      for (const Expression& operand : e.operands())
        for (const Expression& node : partial_nodes(operand)) inner.insert(node);
    Expressions result;
    for (const Expression& e : all)
      if (inner.insert(e).second) result.push_back(e);
    std::sort(result.begin(), result.end(),
              [](const Expression& a, const Expression& b) { return compare(a, b) < 0; });
    return result;
  }

  const Model& model_;
  const Motion& motion_;
  const FormulationOptions options_;
  const bool needs_matrix_ = uses_matrix(options_);
  Substitution substitution_;
  Rewriter rewriter_;
  MatrixForms forms_;  // of A
  Formulation result_;
};

}  // namespace

std::string point_name(int row, int column) {
  return "k_" + std::to_string(row) + "_" + std::to_string(column);
}

namespace {

/// What there is to choose from within a budget.
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
                   FormDetail detail, std::uint64_t budget, const FormingWatch* watch) {
  WorkMeter meter(budget, watch);
  Formulation result = Formulator(model, motion, with_detail(options, detail), meter).run();
  result.detail = detail;
  result.work = meter.spent();
  return result;
}

}  // namespace

Formulation formulate(const Model& model, const Motion& motion, const FormulationOptions& options,
                      const FormingWatch* watch) {
  // A determinant in closed form is nothing but multiplied out, and has a budget of its own.
  if (options.determinant)
    return formed(model, motion, options, FormDetail::kFull, WorkMeter::kNoLimit, watch);
  FormulationOptions adapted = options;
  if (uses_matrix(options) && has_roots_or_quotients(model, motion))
    adapted.rewriting.most_terms = std::min(options.rewriting.most_terms, kMostTermsOfAPart);
  for (const FormDetail detail : {FormDetail::kFull, FormDetail::kSmallParts}) try {
      return formed(model, motion, adapted, detail, options.forming_budget, watch);
    } catch (const OverBudget&) {
    }
  return formed(model, motion, adapted, FormDetail::kAsWritten, WorkMeter::kNoLimit, watch);
}

Formulation formulate_as_written(const Model& model, const Motion& motion,
                                 const FormulationOptions& options) {
  return formed(model, motion, options, FormDetail::kAsWritten, WorkMeter::kNoLimit, nullptr);
}

}  // namespace regulus::codegen
