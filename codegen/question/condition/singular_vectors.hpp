// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace regulus::detail {

/// Singular values, the largest first, and singular vectors; approximately.
struct SingularVectors {
  std::vector<double> values;
  std::vector<double> left;   ///< m×m, row-major, orthogonal; column j < n belongs to values[j]
  std::vector<double> right;  ///< n×n, row-major, orthogonal; column j belongs to values[j]
};

/// Shape     A row-major, rows × columns, rows ≥ columns ≥ 1.
/// Ensures   nullopt if A has an entry that is not finite, or the result overflows.
/// Source    one-sided Jacobi rotations: Hestenes, "Inversion of matrices by biorthogonalization
///           and related results", J. SIAM 6 (1958).
[[nodiscard]] std::optional<SingularVectors> approx_singular_vectors(std::span<const double> A,
                                                                     std::size_t rows,
                                                                     std::size_t columns);

}  // namespace regulus::detail
