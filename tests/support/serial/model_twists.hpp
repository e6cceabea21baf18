// SPDX-License-Identifier: GPL-3.0-or-later
// The columns of a serial arm's Jacobian, from its model.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "codegen/model/model.hpp"
#include "tests/support/evaluate.hpp"
#include "tests/support/serial/forward_kinematics.hpp"

namespace regulus::detail::test {

/// Returns the rows that the model has, "rows v_x, v_y, w_z": 0 to 5.
inline std::vector<std::size_t> kept_rows(const Model& model) {
  std::vector<std::size_t> rows;
  const std::string& note = model.matrix_notes.at(0);
  const std::string names = note.substr(note.find("rows "));
  std::size_t index = 0;
  for (const char* name : {"v_x", "v_y", "v_z", "w_x", "w_y", "w_z"}) {
    if (names.find(name) != std::string::npos) rows.push_back(index);
    ++index;
  }
  return rows;
}

/// Rows that were left out count as zero.
inline std::vector<Twist> model_twists(const Model& model, const std::vector<double>& q) {
  test::Point point;
  for (const GeometryParameter& g : model.geometry) point[g.name] = evaluate(g.value, {});
  for (std::size_t j = 0; j < q.size(); ++j) point[model.pose[j].name] = q[j];
  const std::vector<std::size_t> rows = kept_rows(model);
  const bool transposed = model.matrix_kind == MatrixKind::kForwardTransposed;
  const GiNaC::matrix J = model.jacobian.value_or(model.matrix);
  std::vector<Twist> twists(q.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < q.size(); ++j) {
      const auto row = static_cast<unsigned>(i), column = static_cast<unsigned>(j);
      const double entry = evaluate(transposed ? J(column, row) : J(row, column), point);
      (rows[i] < 3 ? twists[j].velocity[rows[i]] : twists[j].spin[rows[i] - 3]) = entry;
    }
  return twists;
}

/// Expects that both are the columns of one arm at one pose, seen from different links.
inline void expect_same_arm(const std::vector<Twist>& a, const std::vector<Twist>& b,
                            double tolerance = 1e-8) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = i; j < a.size(); ++j) {
      const Invariants one = invariants(a[i], a[j]), other = invariants(b[i], b[j]);
      EXPECT_NEAR(one.spins, other.spins, tolerance) << "joints " << i + 1 << ", " << j + 1;
      EXPECT_NEAR(one.reciprocal, other.reciprocal, tolerance)
          << "joints " << i + 1 << ", " << j + 1;
    }
}

}  // namespace regulus::detail::test
