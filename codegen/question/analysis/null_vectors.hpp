// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace regulus::detail {

/// The null vectors of a nearly singular matrix, by a singular value decomposition in plain
/// doubles. Approximate: no verdict may rest on them.
struct NullVectors {
  /// Singular values of the balanced matrix (balanced_matrix.hpp), relative to the largest, in
  /// decreasing order, one for each column.
  std::vector<double> singular_values;
  /// v with A·v ≈ 0, one for each singular value below kNegligible; entries below it, compared with
  /// the largest in the balanced matrix, are 0.
  std::vector<std::vector<double>> right;
  /// w with wᵀ·A ≈ 0, likewise; none for a matrix with more rows than columns, because its rows are
  /// always dependent.
  std::vector<std::vector<double>> left;

  [[nodiscard]] std::size_t nullity() const noexcept { return right.size(); }
};

/// Relative size below which a singular value, or an entry of a null vector, counts as 0.
inline constexpr double kNegligible = 1e-8;

/// Shape     A is rows×columns, row-major, rows ≥ columns ≥ 1.
/// Requires  every entry finite.
[[nodiscard]] NullVectors approx_null_vectors(std::span<const double> A, std::size_t rows,
                                              std::size_t columns);

}  // namespace regulus::detail
