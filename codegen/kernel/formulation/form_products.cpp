// SPDX-License-Identifier: GPL-3.0-or-later
// K·A and A·K.
#include "codegen/kernel/formulation/formulator.hpp"

namespace regulus::detail {

Formulator::Entry Formulator::combine(const MatrixForms& A, const std::vector<std::string>& points,
                                      const std::vector<std::size_t>& entries) {
  std::vector<PolynomialTerm> terms;
  Expressions natural, rewritten;
  for (std::size_t j = 0; j < points.size(); ++j) {
    const Expression k = point(points[j]);
    const AtomProduct atom(1, of_products().atoms().coefficient_atom(k));
    for (const PolynomialTerm& term : A.expanded[entries[j]].terms())
      terms.push_back(
          {Monomial{term.monomial.variables, multiply(term.monomial.coefficients, atom)},
           term.factor});
    of_products().atoms().spend(1 + A.expanded[entries[j]].terms().size());
    natural.push_back(k * A.natural[entries[j]]);
    rewritten.push_back(k * A.rewritten[entries[j]]);
  }
  return {Polynomial(std::move(terms)), sum(std::move(natural)), sum(std::move(rewritten))};
}

std::vector<Formulator::Entry> Formulator::first_row(const MatrixForms& A) {
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

void Formulator::append_best_forms(const std::vector<Entry>& row, const std::string& function,
                                   Expressions& to) {
  Expressions forms;
  std::vector<EntryStatistics> statistics;
  for (const Entry& entry : row) {
    const Rewritten form = best_form(entry.polynomial, &entry.rewritten);
    forms.push_back(form.expression);
    statistics.push_back({counted(entry.natural), counted(form.expression), form.passes});
  }
  append_rows(forms, statistics, to, result_.statistics[function]);
}

void Formulator::form_left_product() {
  const std::vector<Entry> row = first_row(forms_);
  append_best_forms(row, "left_product", result_.left_product);
  if (options_.derivatives) form_left_derivatives(row);
}

void Formulator::form_left_derivatives(const std::vector<Entry>& row) {
  for (const Variable& v : result_.variables) {
    PolynomialDifferentiator by = differentiator(v.name);
    Expressions forms;
    std::vector<EntryStatistics> statistics;
    for (const Entry& entry : row) {
      const Rewritten form = best_form(by.derivative(entry.polynomial));
      forms.push_back(form.expression);
      statistics.push_back({{}, counted(form.expression), form.passes});
    }
    append_rows(forms, statistics, result_.left_derivatives,
                result_.statistics["left_derivatives"]);
  }
}

void Formulator::append_rows(const Expressions& first,
                             const std::vector<EntryStatistics>& statistics, Expressions& to,
                             std::vector<EntryStatistics>& statistics_to) {
  const std::uint64_t operations = count_operations(first);  // of each row
  for (int i = 1; i <= result_.columns; ++i) {
    Expressions row = first;
    if (i > 1)
      for (Expression& e : row) e = row_replacer(i).apply(e);
    uncounted_.spend(operations);
    to.insert(to.end(), row.begin(), row.end());
    statistics_to.insert(statistics_to.end(), statistics.begin(), statistics.end());
  }
}

Replacer& Formulator::row_replacer(int i) {
  return row_replacers_.try_emplace(i, renaming_rows(i)).first->second;
}

ReplacementOf Formulator::renaming_rows(int i) const {
  std::map<std::string, Expression> names;
  for (int j = 1; j <= result_.rows; ++j) names.emplace(point_name(1, j), point(point_name(i, j)));
  return renaming(std::move(names));
}

ReplacementOf Formulator::renaming_columns(int i) const {
  std::map<std::string, Expression> names;
  for (int j = 1; j <= result_.columns; ++j)
    names.emplace(point_name(j, 1), point(point_name(j, i)));
  return renaming(std::move(names));
}

ReplacementOf Formulator::renaming(std::map<std::string, Expression> names) {
  return [names = std::move(names)](const Expression& e) -> std::optional<Expression> {
    if (e.kind() != ExpressionKind::kPoint) return std::nullopt;
    return names.at(e.name());
  };
}

void Formulator::form_right_product() {
  std::vector<EntryStatistics>& statistics = result_.statistics["right_product"];
  std::vector<Replacer> renamed;
  for (int c = 2; c <= result_.rows; ++c) renamed.emplace_back(renaming_columns(c));
  for (int r = 0; r < result_.rows; ++r) {
    std::vector<std::string> points;
    std::vector<std::size_t> entries;
    for (int j = 0; j < result_.columns; ++j) {
      points.push_back(point_name(j + 1, 1));
      entries.push_back(index(r * result_.columns + j));
    }
    const Entry entry = combine(forms_, points, entries);
    const Rewritten form = best_form(entry.polynomial, &entry.rewritten);
    const EntryStatistics of_entry = {counted(entry.natural), counted(form.expression),
                                      form.passes};
    for (int c = 1; c <= result_.rows; ++c) {
      result_.right_product.push_back(c == 1 ? form.expression
                                             : renamed[index(c - 2)].apply(form.expression));
      statistics.push_back(of_entry);
    }
  }
}

}  // namespace regulus::detail
