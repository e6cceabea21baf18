// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

namespace regulus::detail {

/// A matrix with its columns and then its rows divided by their norms, since they may have
/// different units: entries = diag(row_scale)·A·diag(column_scale). A norm below a millionth of the
/// largest is not scaled up: this row or column may be vanishing.
struct BalancedMatrix {
  Eigen::MatrixXd entries;
  Eigen::VectorXd row_scale, column_scale;
};

/// Shape     A is rows×columns, row-major.
[[nodiscard]] BalancedMatrix balance(std::span<const double> A, std::size_t rows,
                                     std::size_t columns);

}  // namespace regulus::detail
