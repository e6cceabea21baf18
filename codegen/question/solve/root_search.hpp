// SPDX-License-Identifier: GPL-3.0-or-later
// Branch and prune over all unknowns of a system: every solution, and the boxes that may hide others.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "codegen/question/solve/root_judge.hpp"
#include "runtime/search/box_search.hpp"

namespace regulus::detail {

struct RootSettings;

struct RootList {
  std::vector<Root> roots;                  ///< pairwise different
  std::vector<std::vector<Interval>> open;  ///< by unknown: boxes that may hold others
  /// All solutions are in these, if that was asked: the system `regular` of the question is so there.
  std::vector<std::vector<Interval>> regular;
  bool is_complete = false;   ///< there are no others in the ranges, also where X has other places
  bool is_undefined = false;  ///< some open box has no certain value of the equations
  bool is_doubtful = false;   ///< two enclosures overlap, and are not shown to be of one solution
  std::optional<Reason> stopped_by{};
  std::uint64_t boxes = 0;
  double seconds = 0;
};

using RootSearch = std::function<RootList(const RootSettings&)>;

struct RootSettings : BoxSearchSettings {
  /// Boxes are not split in an unknown narrower than this part of its range.
  double min_relative_width = 0x1p-34;
  /// After a box that cannot be split: how many more are judged, because the list will not be whole.
  std::uint64_t boxes_after_problem = 20'000;
  /// Runs each search, with its place in a file for the option --checkpoint; empty: there is none.
  std::function<RootList(const RootSettings&, const RootSearch&)> keep{};
};

/// The settings get what a search has left of its limits.
template <class Found>
void leave_rest(RootSettings& settings, const Found& found) {
  settings.max_boxes -= std::min(settings.max_boxes, found.boxes);
  settings.time_limit -= found.seconds;
}

/// Finds the roots of a system over the ranges of its unknowns. The result does not depend on threads,
/// and not on whether the search was stopped and continued.
///
/// `periods`: by unknown; the equations do not change if it moves by this; 0: no such number.
/// `progress` may be null.
/// Throws    SavedTreeError if settings.from is no tree of this search; the exceptions of the workers.
[[nodiscard]] RootList search_roots(const RootQuestion& question,
                                    const std::vector<Interval>& periods,
                                    const RootSettings& settings, Observer* progress);

}  // namespace regulus::detail
