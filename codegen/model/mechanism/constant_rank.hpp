// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a matrix of joint polynomials that depend on the others at all poses alike.
#pragma once

#include <cstddef>
#include <vector>

#include "codegen/model/mechanism/joint_polynomial.hpp"

namespace regulus::detail {

/// Returns indices of rows so that every other row is a combination of them with coefficients that
/// are the same numbers at all poses and for all values of the geometry. So the matrix of these rows
/// has the same rank everywhere.
///
/// Ensures   proved by exact algebra; all rows if a number there cannot be told from zero, or if the
///           numbers become too long.
/// Throws    what `meter`, if it is not null, throws.
[[nodiscard]] std::vector<std::size_t> independent_rows(
    const std::vector<std::vector<JointPolynomial>>& rows, WorkMeter* meter = nullptr);

}  // namespace regulus::detail
