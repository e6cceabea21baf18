// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/analysis/lost_twist.hpp"

#include <algorithm>
#include <cmath>

#include "codegen/question/engine/point_values.hpp"

namespace regulus::detail {
namespace {

Expressions entries_and_scales(const Formulation& f) {
  Expressions outputs = f.natural_matrix;
  outputs.insert(outputs.end(), f.natural_row_scale.begin(), f.natural_row_scale.end());
  return outputs;
}

double largest(const std::vector<double>& v) {
  return *std::max_element(v.begin(), v.end(),
                           [](double a, double b) { return std::fabs(a) < std::fabs(b); });
}

double norm_of(const std::vector<double>& v, const std::vector<TwistComponent>& components,
               TwistComponent::Kind kind) {
  double squares = 0;
  for (std::size_t j = 0; j < v.size(); ++j)
    if (components[j].kind == kind) squares += v[j] * v[j];
  return std::sqrt(squares);
}

std::vector<double> divided(std::vector<double> v, double by) {
  for (double& x : v) x = x / by + 0.0;  // no −0
  return v;
}

std::vector<double> normalised_row(const std::vector<double>& w) { return divided(w, largest(w)); }

std::vector<double> normalised_twist(const std::vector<double>& v,
                                     const std::vector<TwistComponent>& components) {
  if (components.empty()) return divided(v, largest(v));
  double norm = norm_of(v, components, TwistComponent::Kind::kAngular);
  if (norm == 0) norm = norm_of(v, components, TwistComponent::Kind::kLinear);
  return divided(v, std::copysign(norm, largest(v)));
}

}  // namespace

std::vector<std::size_t> rows_taking_part(const Degeneracy& degeneracy) {
  std::vector<std::size_t> numbers;
  if (degeneracy.rows.empty()) return numbers;
  for (std::size_t i = 0; i < degeneracy.rows.front().size(); ++i)
    if (std::any_of(degeneracy.rows.begin(), degeneracy.rows.end(),
                    [i](const auto& weights) { return std::fabs(weights[i]) > kTakesPart; }))
      numbers.push_back(i + 1);
  return numbers;
}

InverseJacobian::InverseJacobian(const PreparedSearch& p)
    : components_(p.labels.twist),
      rows_(std::size_t(p.labels.rows)),
      columns_(std::size_t(p.labels.columns)),
      entries_(lower_outputs(p.stages->jacobian_formulation(),
                             entries_and_scales(p.stages->jacobian_formulation()))) {}

std::optional<std::vector<double>> InverseJacobian::approx_at(
    std::span<const Interval> variables) const {
  std::optional<std::vector<double>> outputs = approx_values(entries_, variables);
  if (!outputs) return std::nullopt;
  std::vector<double>& values = *outputs;
  const std::size_t entries = rows_ * columns_;
  for (std::size_t i = 0; i + entries < values.size(); ++i)
    for (std::size_t j = 0; j < columns_; ++j) values[i * columns_ + j] *= values[entries + i];
  values.resize(entries);
  return outputs;
}

std::optional<double> InverseJacobian::approx_hadamard(std::span<const Interval> variables,
                                                       bool scaled) const {
  const std::optional<std::vector<double>> outputs = approx_values(entries_, variables);
  if (!outputs) return std::nullopt;
  const std::vector<double>& values = *outputs;
  const std::size_t entries = rows_ * columns_;
  double product = 1;
  for (std::size_t i = 0; i < rows_; ++i) {
    double squares = 0;
    for (std::size_t j = 0; j < columns_; ++j)
      squares += values[i * columns_ + j] * values[i * columns_ + j];
    const bool has_scale = scaled && entries + i < values.size();
    product *= std::sqrt(squares) * (has_scale ? std::fabs(values[entries + i]) : 1);
  }
  return product;
}

std::optional<Degeneracy> InverseJacobian::approx_degeneracy(
    std::span<const Interval> variables) const {
  const std::optional<std::vector<double>> J = approx_at(variables);
  if (!J) return std::nullopt;
  NullVectors null = approx_null_vectors(*J, rows_, columns_);
  Degeneracy degeneracy;
  degeneracy.singular_values = std::move(null.singular_values);
  for (const auto& v : null.right) degeneracy.twists.push_back(normalised_twist(v, components_));
  for (const auto& w : null.left) degeneracy.rows.push_back(normalised_row(w));
  return degeneracy;
}

}  // namespace regulus::detail
