// SPDX-License-Identifier: GPL-3.0-or-later
// The solutions of a system move while its variables are anywhere in their ranges: tubes enclose them.
#pragma once

#include "codegen/question/solve/followed_tubes.hpp"
#include "codegen/question/solve/system_solutions.hpp"

namespace regulus::detail {

/// Returns the problem in which all that is uncertain is in the middle of its range. It has `shape`.
[[nodiscard]] Problem at_middles(Problem problem, const ClosedShape& shape);

/// Returns the problem with what is uncertain at ends of its ranges at which a solution is nearer to a
/// singular one, by one step each, than it is at the middles. Points in balls stay in the middle.
///
/// Shape     solution: by unknown, at the middles.
[[nodiscard]] Problem towards_singular(const Problem& problem, const PreparedSystem& prepared,
                                       const std::vector<Interval>& solution);

/// Follows the solutions at some values of the variables to all others, as follow_in_ranges() does.
///
/// Requires  solutions: as there, in the ranges of the problem.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] SolutionTubes follow_solutions(const Problem& problem, const PreparedSystem& prepared,
                                             const std::vector<Interval>& periods,
                                             const std::vector<std::vector<Interval>>& solutions,
                                             RootSettings settings, Observer* progress);

}  // namespace regulus::detail
