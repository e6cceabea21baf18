// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace regulus::detail {

/// A left inverse of an m×n matrix A, and a basis of the vectors x with Aᵀx = 0; approximately.
struct LeftInverse {
  std::vector<double> inverse;     ///< n×m, row-major: inverse·A ≈ I
  std::vector<double> null_space;  ///< m×(m − n), row-major, orthonormal columns
};

/// Shape     A row-major, rows × columns, rows ≥ columns.
/// Ensures   nullopt if A seems to lack full column rank.
[[nodiscard]] std::optional<LeftInverse> approx_left_inverse(std::span<const double> A,
                                                             std::size_t rows, std::size_t columns);

}  // namespace regulus::detail
