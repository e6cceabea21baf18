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
                                   ProductForms& to) {
  Expressions forms;
  std::vector<EntryStatistics> statistics;
  for (const Entry& entry : row) {
    const Rewritten form = best_form(entry.polynomial, &entry.rewritten);
    forms.push_back(form.expression);
    statistics.push_back({counted(entry.natural), counted(form.expression), form.passes});
  }
  append_block(forms, statistics, to, result_.statistics[function]);
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
    append_block(forms, statistics, result_.left_derivatives,
                 result_.statistics["left_derivatives"]);
  }
}

void Formulator::append_block(const Expressions& block,
                              const std::vector<EntryStatistics>& statistics, ProductForms& to,
                              std::vector<EntryStatistics>& statistics_to) const {
  to.block = block.size();
  to.first.insert(to.first.end(), block.begin(), block.end());
  for (int i = 0; i < result_.columns; ++i)
    statistics_to.insert(statistics_to.end(), statistics.begin(), statistics.end());
}

namespace {

/// Returns e with other entries of K; `moved` gives the row and column of one, from those in e.
template <class Moved>
Expression with_points(const Expression& e, Moved moved) {
  return substitute(e, [&](const Expression& part) -> std::optional<Expression> {
    if (part.kind() != ExpressionKind::kPoint) return std::nullopt;
    const std::string& name = part.name();  // k_1_2
    const std::size_t second = name.rfind('_');
    return moved(std::stoi(name.substr(2, second - 2)), std::stoi(name.substr(second + 1)));
  });
}

}  // namespace

Expression in_row(const Expression& e, int row) {
  return with_points(e, [row](int, int column) { return point(point_name(row, column)); });
}

Expression in_column(const Expression& e, int column) {
  return with_points(e, [column](int row, int) { return point(point_name(row, column)); });
}

void Formulator::form_right_product() {
  std::vector<EntryStatistics>& statistics = result_.statistics["right_product"];
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
    result_.right_product.first.push_back(form.expression);
    statistics.insert(statistics.end(), index(result_.rows), of_entry);
  }
}

}  // namespace regulus::detail
