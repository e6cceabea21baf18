// SPDX-License-Identifier: GPL-3.0-or-later
// The determinant of a serial arm's forward Jacobian as a product of functions of few joints.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "codegen/model/model.hpp"

namespace regulus::detail {

/// A trigonometric polynomial of joint variables.
struct DeterminantFactor {
  GiNaC::ex value;
  std::vector<std::size_t> joints;  ///< indices into Model::pose of the variables that occur
  int power = 1;
};

/// A square block of the Jacobian, in whose rows and columns nothing else matters.
struct DeterminantBlock {
  GiNaC::matrix entries;
  bool is_factored = false;
  GiNaC::ex constant = 1;  ///< a number times powers of geometry
  std::vector<DeterminantFactor> factors{};
};

/// Splits a square matrix into blocks on its diagonal, after exchanging rows and columns, with zeros
/// on one side of them; and factors the determinant of each: by sines and cosines that all its terms
/// have, and by rational factors in the tangents of half the angles.
///
/// Ensures   the determinant is the product of those of the blocks, at all poses and for all values
///           of the geometry: the first row of the first block has the sign that the exchanges give.
///           If a block is factored, its determinant is `constant` times the product of the factors
///           with their powers: proved, by exact algebra. A block that is singular at all poses or
///           has too many terms is not factored.
[[nodiscard]] std::vector<DeterminantBlock> determinant_blocks(
    const GiNaC::matrix& A, const std::vector<PoseParameter>& pose);

/// Returns a matrix of the same order with the same determinant: the factors of each block on the
/// diagonal, or the block itself if one of them has many terms; nullopt if this leaves the matrix as
/// it is.
[[nodiscard]] std::optional<GiNaC::matrix> matrix_of_factors(
    const std::vector<DeterminantBlock>& blocks);

}  // namespace regulus::detail
