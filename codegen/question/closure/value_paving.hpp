// SPDX-License-Identifier: GPL-3.0-or-later
// Decides for each box of a motion on which side of a limit a value is over the branch: whether the
// motors of a closure hold a load, or a determinant exceeds a threshold.
#pragma once

#include "codegen/question/closure/closure_run.hpp"
#include "codegen/question/closure/value_search.hpp"
#include "codegen/question/load/feasibility_search.hpp"

namespace regulus::detail {

struct BranchPaving {
  bool is_feasible = false;           ///< every box is feasible or outside
  bool is_empty = false;              ///< every box is outside
  std::optional<BranchTube> place{};  ///< over a place where the value is beyond the limit
  std::vector<Interval> at{};         ///< that place, by variable
  std::optional<Reason> stopped_by{};
  std::uint64_t boxes = 0;
  double seconds = 0;
  BranchTree tree{};                 ///< of all boxes, with tubes on the branch
  std::vector<const char*> words{};  ///< by leaf of the tree, of FORMAT.md

  /// Gives the leaves that are outside the words for tubes, or for none, as they have them.
  void name_excluded();
};

/// A box is feasible if the value is below `aim.below` all over it, and infeasible if it is at least
/// `aim.from`. One that is not on the branch for certain is undecided; so is one that `resolution`, as a
/// part of each range, does not let split.
///
/// Requires  aim.below, aim.from.
///
/// Throws    the exceptions of the workers; SavedTreeError if `settings.from` is no tree of this search.
[[nodiscard]] BranchPaving pave_values(const ValueQuestion& question, const ClosureResult& branch,
                                       const ValueAim& aim, double resolution,
                                       const BoxSearchSettings& settings,
                                       const IsPossible& is_possible, const ForceListener& listener,
                                       Observer* progress);

}  // namespace regulus::detail
