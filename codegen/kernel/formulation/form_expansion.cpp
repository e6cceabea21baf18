// SPDX-License-Identifier: GPL-3.0-or-later
// Taylor's expansion of K·A.
#include <algorithm>
#include <set>

#include "codegen/kernel/formulation/formulator.hpp"
#include "codegen/kernel/symbolic/from_ginac.hpp"

namespace regulus::detail {

std::vector<int> Formulator::rows_of_variables() {
  std::map<std::string, std::set<int>> rows;
  if (options_.rows)
    for (std::size_t e = 0; e < forms_.rewritten.size(); ++e)
      for (const auto& [name, count] : count_occurrences(revealed(forms_.rewritten[e])))
        rows[name].insert(static_cast<int>(e) / result_.columns);
  std::vector<int> result;
  for (const Variable& v : result_.variables) {
    const std::set<int>& of_variable = rows[v.name];
    const bool one = v.kind != VariableKind::kMotion && of_variable.size() == 1;
    result.push_back(one ? *of_variable.begin() : Expansion::kNoRow);
  }
  return result;
}

bool Formulator::has_row_quantity() {
  return std::ranges::any_of(rows_of_variables(), [](int row) { return row != Expansion::kNoRow; });
}

void Formulator::form_expansion(bool at_nominal) {
  ExpansionForms& x = result_.expansion.emplace();
  x.row_of_variable = rows_of_variables();
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

Formulator::MatrixForms Formulator::nominal_forms(const std::map<std::string, Expression>& values) {
  const ReplacementOf value_of = [&](const Expression& e) -> std::optional<Expression> {
    if (e.kind() != ExpressionKind::kVariable) return std::nullopt;
    const auto found = values.find(e.name());
    return found == values.end() ? std::nullopt : std::optional(found->second);
  };
  MatrixForms A;
  A.natural = substitute(forms_.natural, value_of);
  A.formed = substitute(forms_.formed, value_of);
  if (parts_) {
    A.natural = A.formed;
    for (Expression& formed : A.formed) formed = parts_->hide(formed);
  }
  for (const Expression& formed : A.formed) {
    A.expanded.push_back(of_products().expand(formed));
    A.rewritten.push_back(of_products().rewrite(formed).expression);
  }
  return A;
}

void Formulator::form_expansion_of(const std::vector<Entry>& row) {
  ExpansionForms& x = *result_.expansion;
  std::vector<PolynomialDifferentiator> by;
  for (const Variable& v : result_.variables) by.push_back(differentiator(v.name));
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

void Formulator::append_column(DerivativeIndex place, const Polynomial& p,
                               const std::string& function, ProductDerivatives& to) {
  if (p.is_zero()) return;
  const Rewritten form = of_products().nested_form(p);
  append_block({form.expression}, {{{}, counted(form.expression), form.passes}}, to.forms,
               result_.statistics[function]);
  for (place.row = 0; place.row < result_.columns; ++place.row) to.places.push_back(place);
}

void Formulator::form_row_derivatives(int i, int j, std::vector<PolynomialDifferentiator>& by) {
  ExpansionForms& x = *result_.expansion;
  const Polynomial& entry = forms_.expanded[index(i * result_.columns + j)];
  const auto append = [&](const DerivativeIndex& place, const Polynomial& p,
                          const std::string& function, DerivativeForms& to) {
    if (p.is_zero()) return;
    const Rewritten form = of_products().quick_form(p);
    to.places.push_back(place);
    to.forms.push_back(form.expression);
    result_.statistics[function].push_back({{}, counted(form.expression), form.passes});
  };
  for (std::size_t k = 0; k < by.size(); ++k) {
    if (x.row_of_variable[k] != i) continue;
    const int variable = static_cast<int>(k);
    const Polynomial first = by[k].derivative(entry);
    append({i, j, variable}, first, "row_first", x.row_first);
    for (std::size_t q = 0; q < by.size(); ++q) {
      const bool same_row = x.row_of_variable[q] == i;
      if (same_row && q < k) continue;  // the other order gives it
      const int other = static_cast<int>(q);
      append({i, j, std::min(variable, other), std::max(variable, other)}, by[q].derivative(first),
             "row_second", x.row_second);
    }
  }
}

}  // namespace regulus::detail
