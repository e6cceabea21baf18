// SPDX-License-Identifier: GPL-3.0-or-later
// The ranges by which the symbolic stage makes its choices: the scaling of a matrix and its column
// operations.
//
// No verdict depends on these choices, so they need not be made for the ranges of one question.
// They are made for rounded ranges, which many questions share: then the forms of one question are
// those of the others, to the last operation, and a cache can keep them.
#pragma once

#include <vector>

#include "codegen/kernel/symbolic/variable.hpp"

namespace regulus::detail {

/// Returns the variables with rounded ranges.
///
/// Ensures   each range contains the given one, up to rounding, except that a range of one point
///           becomes a number near it. The half-width is at most 5/4 of the given one for a motion
///           parameter, 17/8 for an uncertain quantity. The ends are rational numbers. They depend on
///           the values of the given ends, not on the expressions for them. A range whose ends have
///           no finite value stays as it is.
[[nodiscard]] std::vector<Variable> with_typical_ranges(std::vector<Variable> variables);

}  // namespace regulus::detail
