// SPDX-License-Identifier: GPL-3.0-or-later
// Solutions that move while uncertain quantities are anywhere in a connected set: tubes enclose them.
#pragma once

#include "codegen/question/solve/root_search.hpp"

namespace regulus::detail {

struct SolutionTubes {
  /// By solution: encloses where it is; nullopt: it may meet another one, vanish, or leave the ranges.
  std::vector<std::optional<std::vector<Interval>>> tubes;
  /// By solution: boxes in which it stays; none if it has no tube.
  std::vector<std::vector<std::vector<Interval>>> parts{};
  bool are_all = false;                     ///< there are no others, at any values of the variables
  std::vector<std::vector<Interval>> open;  ///< by unknown: boxes that may hold singular solutions
  std::optional<Reason> stopped_by{};
  std::uint64_t boxes = 0;
  double seconds = 0;
};

/// Says where solutions are followed, by unknown.
struct FollowedRanges {
  std::vector<Interval> searched, periods;  ///< a period 0: it does not turn
  /// Says where a solution may go beyond an end of the range. It stays within the others.
  std::vector<bool> may_leave;
};

/// Searches a box of the unknowns for `regular` boxes (root_search.hpp), at all values of the variables.
using SearchFollowed =
    std::function<RootList(const std::vector<Interval>& box, const RootSettings& settings)>;

/// Follows the solutions at some values of the variables to all others.
///
/// Requires  solutions: enclosures of all that there are at the same values of the variables, in the ranges.
/// Ensures   a solution with a tube moves on without a jump, within its tube, as the variables change,
///           and is regular. If are_all: all have tubes, and there are as many at all values.
[[nodiscard]] SolutionTubes follow_in_ranges(const FollowedRanges& ranges,
                                             const SearchFollowed& search,
                                             const std::vector<std::vector<Interval>>& solutions,
                                             RootSettings settings);

}  // namespace regulus::detail
