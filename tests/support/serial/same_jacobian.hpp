// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the matrix of a serial arm's model means what twists of its tool do, at many poses.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "codegen/model/model.hpp"
#include "tests/support/evaluate.hpp"
#include "tests/support/serial/forward_kinematics.hpp"

namespace regulus::detail::test {

using Table = std::vector<std::vector<double>>;  ///< by rows

/// Orthogonalizes the rows, the largest first, and returns their lengths.
inline std::vector<double> pivot_lengths(Table rows) {
  std::vector<double> lengths;
  while (!rows.empty()) {
    const auto square = [](const std::vector<double>& row) {
      double sum = 0;
      for (const double x : row) sum += x * x;
      return sum;
    };
    const auto largest = std::ranges::max_element(rows, {}, square);
    const std::vector<double> pivot = *largest;
    rows.erase(largest);
    lengths.push_back(std::sqrt(square(pivot)));
    if (lengths.back() == 0) continue;
    for (auto& row : rows)
      for (int twice = 0; twice < 2; ++twice) {
        double along = 0;
        for (std::size_t k = 0; k < row.size(); ++k) along += row[k] * pivot[k];
        along /= square(pivot);
        for (std::size_t k = 0; k < row.size(); ++k) row[k] -= along * pivot[k];
      }
  }
  return lengths;
}

/// The rank of a matrix with an error of about 1e-9; −1 where it cannot be told.
inline int rank_of(const Table& rows) {
  int rank = 0;
  for (const double length : pivot_lengths(rows)) {
    if (length > 1e-7 && length < 1e-4) return -1;
    rank += length >= 1e-4 ? 1 : 0;
  }
  return rank;
}

/// A matrix of expressions at a pose.
inline Table values_of(const GiNaC::matrix& A, const Model& model, const std::vector<double>& q) {
  Point point;
  for (const GeometryParameter& g : model.geometry) point[g.name] = evaluate(g.value, {});
  for (std::size_t j = 0; j < q.size(); ++j) point[model.pose[j].name] = q[j];
  Table table(A.rows(), std::vector<double>(A.cols()));
  for (unsigned i = 0; i < A.rows(); ++i)
    for (unsigned j = 0; j < A.cols(); ++j) table[i][j] = evaluate(A(i, j), point);
  return table;
}

/// The Jacobian of the model: a column for each joint.
inline Table jacobian_of(const Model& model, const std::vector<double>& q) {
  const GiNaC::matrix J = model.jacobian.value_or(model.matrix);
  return values_of(model.matrix_kind == MatrixKind::kForwardTransposed ? J.transpose() : J, model,
                   q);
}

/// Rows v and ω of twists.
inline Table table_of(const std::vector<Twist>& twists) {
  Table table(6);
  for (const Twist& twist : twists)
    for (std::size_t i = 0; i < 3; ++i) {
      table[i].push_back(twist.velocity[i]);
      table[3 + i].push_back(twist.spin[i]);
    }
  return table;
}

/// Rows that the model leaves out are combinations of its rows J, with coefficients that are the same
/// at all poses. So for each pair of joints, ω·ω' and v·ω' + ω·v' are quadratic forms of columns of J,
/// the same at all poses. Their coefficients are fitted.
class SameJacobian {
 public:
  /// Compares the ranks and the row spaces at a pose, and adds the equations of it.
  void add(const Table& model, const std::vector<Twist>& twists) {
    const Table expected = table_of(twists);
    Table both = model;
    both.insert(both.end(), expected.begin(), expected.end());
    const int rank = rank_of(expected);
    if (rank >= 0 && rank_of(model) >= 0 && rank_of(both) >= 0) {
      ++compared_;
      EXPECT_EQ(rank_of(model), rank);
      EXPECT_EQ(rank_of(both), rank) << "other rows";
    }
    for (std::size_t i = 0; i < twists.size(); ++i)
      for (std::size_t j = i; j < twists.size(); ++j) {
        std::vector<double> equation;
        for (std::size_t a = 0; a < model.size(); ++a)
          for (std::size_t b = a; b < model.size(); ++b)
            equation.push_back(model[a][i] * model[b][j] + model[b][i] * model[a][j]);
        const Invariants known = invariants(twists[i], twists[j]);
        equations_.push_back(std::move(equation));
        spins_.push_back(known.spins);
        reciprocals_.push_back(known.reciprocal);
      }
  }

  [[nodiscard]] bool has_enough() const {
    return !equations_.empty() && equations_.size() > 2 * equations_[0].size();
  }
  [[nodiscard]] int compared() const { return compared_; }

  void expect_forms() const {
    EXPECT_LT(residual(spins_), 1e-6) << "angular velocities";
    EXPECT_LT(residual(reciprocals_), 1e-6) << "velocities and angular velocities";
  }

 private:
  /// The largest part of the right side that no combination of the unknowns' columns gives.
  [[nodiscard]] double residual(std::vector<double> right) const {
    Table columns(equations_[0].size(), std::vector<double>(right.size()));
    for (std::size_t e = 0; e < right.size(); ++e)
      for (std::size_t u = 0; u < columns.size(); ++u) columns[u][e] = equations_[e][u];
    const auto product = [](const auto& x, const auto& y) {
      double sum = 0;
      for (std::size_t k = 0; k < x.size(); ++k) sum += x[k] * y[k];
      return sum;
    };
    const auto remove = [&product](auto& x, const auto& pivot) {
      for (int twice = 0; twice < 2; ++twice) {
        const double along = product(x, pivot) / product(pivot, pivot);
        for (std::size_t k = 0; k < x.size(); ++k) x[k] -= along * pivot[k];
      }
    };
    while (!columns.empty()) {
      const auto largest =
          std::ranges::max_element(columns, {}, [&](const auto& c) { return product(c, c); });
      const std::vector<double> pivot = *largest;
      columns.erase(largest);
      if (product(pivot, pivot) < 1e-18) break;
      for (auto& column : columns) remove(column, pivot);
      remove(right, pivot);
    }
    double most = 0;
    for (const double x : right) most = std::max(most, std::fabs(x));
    return most;
  }

  Table equations_;
  std::vector<double> spins_, reciprocals_;
  int compared_ = 0;
};

}  // namespace regulus::detail::test
