// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/nearly_singular.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "codegen/model/exact/point_values.hpp"

namespace regulus::detail {
namespace {

using DoubleRows = std::vector<std::vector<double>>;

DoubleRows approx_values(const GiNaC::matrix& J, const GiNaC::exmap& values) {
  PointValues at(values);
  DoubleRows rows(J.rows());
  for (unsigned i = 0; i < J.rows(); ++i)
    for (unsigned j = 0; j < J.cols(); ++j) rows[i].push_back(at.of(J(i, j)));
  return rows;
}

/// Divides rows by their largest entry.
void scale(DoubleRows& rows, std::size_t first, std::size_t end) {
  double most = 0;
  for (std::size_t i = first; i < end; ++i)
    for (const double x : rows[i]) most = std::max(most, std::fabs(x));
  for (std::size_t i = first; i < end && most > 0; ++i)
    for (double& x : rows[i]) x /= most;
}

void scale_columns(DoubleRows& rows) {
  for (std::size_t j = 0; j < rows.size(); ++j) {
    double square = 0;
    for (const auto& row : rows) square += row[j] * row[j];
    for (auto& row : rows) row[j] /= square == 0 ? 1 : std::sqrt(square);
  }
}

/// The determinant by elimination; NaN if an entry has no value.
double approx_determinant(DoubleRows rows) {
  double ratio = 1;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto size = [k](const auto& row) { return std::fabs(row[k]); };
    std::iter_swap(
        rows.begin() + std::ptrdiff_t(k),
        std::max_element(rows.begin() + std::ptrdiff_t(k), rows.end(),
                         [&](const auto& a, const auto& b) { return size(a) < size(b); }));
    ratio *= rows[k][k];
    if (ratio == 0) return 0;
    for (std::size_t i = k + 1; i < rows.size(); ++i)
      for (std::size_t j = rows.size(); j-- > k;)
        rows[i][j] -= rows[i][k] / rows[k][k] * rows[k][j];
  }
  return std::fabs(ratio);
}

}  // namespace

std::optional<double> approx_nearly_singular(const Model& model, const GiNaC::matrix& J,
                                             std::size_t lengths) {
  if (J.rows() != J.cols()) return std::nullopt;
  constexpr int kPoses = 8;
  constexpr double kGolden = 0.6180339887498949;
  GiNaC::exmap values;
  for (const GeometryParameter& g : model.geometry) values[g.symbol] = g.value;
  double best = 0, place = 0;
  for (int pose = 0; pose < kPoses; ++pose) {
    for (const PoseParameter& p : model.pose) {
      place = std::fmod(place + kGolden, 1);  // spread over the interval
      values[p.symbol] = GiNaC::numeric(6 * place - 3);
    }
    DoubleRows rows = approx_values(J, values);
    scale(rows, 0, lengths);
    scale(rows, lengths, rows.size());
    scale_columns(rows);
    const double ratio = approx_determinant(std::move(rows));
    if (!(ratio < kNearlySingular)) return std::nullopt;
    best = std::max(best, ratio);
  }
  return best;
}

}  // namespace regulus::detail
