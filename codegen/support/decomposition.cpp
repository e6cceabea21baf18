// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/decomposition.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace regulus::detail {

using Eigen::MatrixXd;
using Eigen::VectorXd;

SingularValueDecomposition decompose(const MatrixXd& A) {
  const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.matrixV(), svd.singularValues()};
}

VectorXd singular_values(const MatrixXd& A) {
  return Eigen::JacobiSVD<MatrixXd>(A).singularValues();
}

double determinant(const MatrixXd& A) { return A.determinant(); }

VectorXd solve_least_squares(const MatrixXd& A, const VectorXd& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}

PivotedColumns pivot(const MatrixXd& A) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(A);
  const auto& order = qr.colsPermutation().indices();
  return {{order.begin(), order.end()}, qr.matrixR().diagonal()};
}

}  // namespace regulus::detail
