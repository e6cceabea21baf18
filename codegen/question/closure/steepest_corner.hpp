// SPDX-License-Identifier: GPL-3.0-or-later
// Where a branch may end in a set of many variables, of which boxes would find the place late: the
// determinant becomes smallest, in general, at a corner of the ranges.
#pragma once

#include <optional>
#include <vector>

#include "codegen/question/closure/closure_run.hpp"

namespace regulus::detail {

/// Goes to the corner of the ranges at which |det Φ_p| is smallest by its derivatives at the start, from
/// there to the one that those say, and so on, until the branch is lost on the way. Approximate.
///
/// Shape     the result: by variable, within the ranges; nullopt if no such corner is found.
[[nodiscard]] std::optional<std::vector<double>> steepest_corner(const PreparedClosure& prepared);

}  // namespace regulus::detail
