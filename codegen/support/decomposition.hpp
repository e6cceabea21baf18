// SPDX-License-Identifier: GPL-3.0-or-later
// Decompositions of dense matrices, in doubles, for planning and for reports: never for a proof. Eigen's
// templates are compiled here alone.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace regulus::detail {

/// A = u·diag(sigma)·vᵀ, with square u and v; the largest singular value first.
struct SingularValueDecomposition {
  Eigen::MatrixXd u, v;
  Eigen::VectorXd sigma;
};

[[nodiscard]] SingularValueDecomposition decompose(const Eigen::MatrixXd& A);

/// The largest first.
[[nodiscard]] Eigen::VectorXd singular_values(const Eigen::MatrixXd& A);

[[nodiscard]] double determinant(const Eigen::MatrixXd& A);

/// Returns the shortest of the x for which |A·x − b| is least.
[[nodiscard]] Eigen::VectorXd solve_least_squares(const Eigen::MatrixXd& A,
                                                  const Eigen::VectorXd& b);

/// The columns of A in an order in which the first ones depend on each other least, and how long each is
/// beyond those before it, with a sign.
struct PivotedColumns {
  std::vector<Eigen::Index> order;
  Eigen::VectorXd beyond;  ///< as many as A has rows or columns, the fewer
};

[[nodiscard]] PivotedColumns pivot(const Eigen::MatrixXd& A);

}  // namespace regulus::detail
