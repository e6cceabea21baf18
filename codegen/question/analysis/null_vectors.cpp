// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/analysis/null_vectors.hpp"

#include <cmath>

#include "codegen/question/engine/balanced_matrix.hpp"
#include "codegen/support/decomposition.hpp"

namespace regulus::detail {
namespace {

/// Returns the vector in the units of the given matrix.
std::vector<double> unbalanced(Eigen::VectorXd v, const Eigen::VectorXd& scale) {
  const double largest = v.cwiseAbs().maxCoeff();
  for (double& x : v)
    if (std::fabs(x) <= kNegligible * largest) x = 0;
  v = v.cwiseProduct(scale);
  return {v.begin(), v.end()};
}

}  // namespace

NullVectors approx_null_vectors(std::span<const double> A, std::size_t rows, std::size_t columns) {
  const BalancedMatrix balanced = balance(A, rows, columns);
  const SingularValueDecomposition svd = decompose(balanced.entries);
  const Eigen::VectorXd& sigma = svd.sigma;
  NullVectors result;
  for (Eigen::Index k = 0; k < sigma.size(); ++k) {
    const double relative = sigma(0) > 0 ? sigma(k) / sigma(0) : 0;
    result.singular_values.push_back(relative);
    if (relative > kNegligible) continue;
    result.right.push_back(unbalanced(svd.v.col(k), balanced.column_scale));
    if (rows == columns) result.left.push_back(unbalanced(svd.u.col(k), balanced.row_scale));
  }
  return result;
}

}  // namespace regulus::detail
