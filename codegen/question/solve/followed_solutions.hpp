// SPDX-License-Identifier: GPL-3.0-or-later
// The solutions of a system move while its variables are anywhere in their ranges: tubes enclose them.
#pragma once

#include "codegen/question/solve/system_solutions.hpp"

namespace regulus::detail {

struct SolutionTubes {
  /// By solution: encloses where it is; nullopt: it may meet another one, vanish, or leave the ranges.
  std::vector<std::optional<std::vector<Interval>>> tubes;
  bool are_all = false;                     ///< there are no others, at any values of the variables
  std::vector<std::vector<Interval>> open;  ///< by unknown: boxes that may hold singular solutions
  std::optional<Reason> stopped_by{};
  std::uint64_t boxes = 0;
  double seconds = 0;
};

/// Returns the problem in which all that is uncertain is in the middle of its range. It has `shape`.
[[nodiscard]] Problem at_middles(Problem problem, const ClosedShape& shape);

/// Returns the problem with what is uncertain at ends of its ranges at which a solution is nearer to a
/// singular one, by one step each, than it is at the middles. Points in balls stay in the middle.
///
/// Shape     solution: by unknown, at the middles.
[[nodiscard]] Problem towards_singular(const Problem& problem, const PreparedSystem& prepared,
                                       const std::vector<Interval>& solution);

/// Follows the solutions at some values of the variables to all others.
///
/// Requires  solutions: enclosures of all that there are at the same values of the variables, in the
///           ranges of the problem.
/// Ensures   a solution with a tube moves on without a jump, within its tube, as the variables change,
///           and is regular. If are_all: all have tubes, and there are as many at all values.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] SolutionTubes follow_solutions(const Problem& problem, const PreparedSystem& prepared,
                                             const std::vector<Interval>& periods,
                                             const std::vector<std::vector<Interval>>& solutions,
                                             RootSettings settings, Observer* progress);

}  // namespace regulus::detail
