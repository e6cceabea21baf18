// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "runtime/verifier/ball.hpp"

namespace regulus::verifier {

/// Stored column by column.
using Matrix = std::vector<double>;

/// Computes K, columns × rows, with K·A ≈ I. A is given row by row and has independent columns.
/// Returns false if elimination breaks down. Nothing is claimed about K.
[[nodiscard]] bool approx_left_inverse(const std::vector<double>& A, std::size_t rows,
                                       std::size_t columns, Matrix& K);

/// Returns the rows of A, which is given row by row, that elimination uses.
///
/// Ensures   they are linearly independent for every member of A. If they are as many as the
///           columns, every member has full column rank.
[[nodiscard]] std::vector<std::size_t> independent_rows(std::vector<Ball> A, std::size_t rows,
                                                        std::size_t columns, long bits);

/// Encloses the determinant of a square matrix, given row by row or column by column.
[[nodiscard]] Ball determinant(const std::vector<Ball>& A, std::size_t order, long bits);
[[nodiscard]] Ball determinant(const std::vector<double>& A, std::size_t order, long bits);

/// Returns an upper bound of the spectral norm of a rows×c matrix.
[[nodiscard]] double spectral_norm(const std::vector<double>& X, std::size_t rows, std::size_t c);

}  // namespace regulus::verifier
