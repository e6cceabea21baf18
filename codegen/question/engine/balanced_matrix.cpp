// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/balanced_matrix.hpp"

namespace regulus::detail {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kMayVanish = 1e-6;

/// Returns 1/norm, or 1/(largest norm) for a row or column that may be vanishing.
Eigen::VectorXd scales(const Eigen::VectorXd& norms) {
  const double largest = norms.maxCoeff();
  if (!(largest > 0)) return Eigen::VectorXd::Ones(norms.size());
  return norms.unaryExpr(
      [largest](double norm) { return 1 / (norm > kMayVanish * largest ? norm : largest); });
}

}  // namespace

BalancedMatrix balance(std::span<const double> A, std::size_t rows, std::size_t columns) {
  BalancedMatrix result;
  result.entries = Eigen::Map<const RowMajor>(A.data(), Eigen::Index(rows), Eigen::Index(columns));
  result.column_scale = scales(result.entries.colwise().norm().transpose());
  result.entries = result.entries * result.column_scale.asDiagonal();
  result.row_scale = scales(result.entries.rowwise().norm());
  result.entries = result.row_scale.asDiagonal() * result.entries;
  return result;
}

}  // namespace regulus::detail
