// SPDX-License-Identifier: GPL-3.0-or-later
// The poses that a robot reaches: where no root of its matrix is certainly negative.
#pragma once

#include <vector>

#include "codegen/model/model.hpp"

namespace regulus::detail {

/// Returns the operands of the square roots in matrix, row scales and conditions that depend on the
/// pose and can be negative: where one is, the robot has no such pose. Sums of squares are left out.
///
/// Ensures   each once, in the same order in every process.
[[nodiscard]] std::vector<GiNaC::ex> operands_of_roots(const Model& model);

/// Makes the poses that the robot reaches the set of the motion: sets Motion::reach, and replaces in
/// the constraints the roots of these operands by roots of their absolute values. These are the same
/// wherever the operand is not negative, and have a value at all other poses, too, so that a pose
/// out of reach is excluded whatever the other constraints are.
void restrict_to_reach(const Model& model, Motion& motion);

}  // namespace regulus::detail
