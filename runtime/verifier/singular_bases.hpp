// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace regulus::verifier {

/// Two matrices, row by row, that are roughly orthogonal.
struct SingularBases {
  std::vector<double> U;  ///< rows × rows; its first columns are left singular vectors
  std::vector<double> V;  ///< columns × columns: right singular vectors, of the largest value first
};

/// Returns approximate singular vectors of a matrix, given row by row with rows ≥ columns. Nothing
/// is claimed about them. V is empty if a number is not finite; U is empty also if the matrix is
/// nearly singular.
[[nodiscard]] SingularBases approx_singular_bases(std::vector<double> A, std::size_t rows,
                                                  std::size_t columns);

}  // namespace regulus::verifier
