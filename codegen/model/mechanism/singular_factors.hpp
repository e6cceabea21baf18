// SPDX-License-Identifier: GPL-3.0-or-later
// The singularities of a serial arm as factors of its determinant.
#pragma once

#include <string>
#include <vector>

#include "codegen/model/model.hpp"

namespace regulus::detail {

/// A factor of the determinant: the arm is singular where it is zero.
struct SingularFactor {
  std::string name;  ///< wrist, elbow, shoulder; empty: it has no usual name
  std::string text;  ///< times a number that is left out
};

/// Factors the determinant of a square forward Jacobian (determinant_factors.hpp), for explanations.
///
/// Ensures   the determinant is a number other than zero times the product of the factors, each to a
///           positive power; empty if the matrix is of another kind, is singular at all poses, has
///           too many terms, or does not factor.
[[nodiscard]] std::vector<SingularFactor> singular_factors(const Model& model);

}  // namespace regulus::detail
