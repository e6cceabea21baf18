// SPDX-License-Identifier: GPL-3.0-or-later
// Branch and prune: do forces within the limits hold the load at every pose of a variety?
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "codegen/question/load/box_forces.hpp"
#include "codegen/question/load/force_claim.hpp"
#include "runtime/search/box_search.hpp"

namespace regulus::detail {

struct FeasibilitySettings : BoxSearchSettings {
  /// Boxes are not split in a parameter narrower than this part of its range.
  double min_relative_width = 0x1p-40;
  bool paves = false;  ///< decide every box, also after a witness
};

struct FeasibilityResult {
  FeasibilityVerdict verdict = FeasibilityVerdict::kPossibleProblem;
  /// kUncertainty: at one pose the test fails, whatever the size of the box; also if nothing is
  /// uncertain.
  Reason reason = Reason::kAllBoxesCertified;
  std::uint64_t boxes = 0;
  double seconds = 0;
  std::optional<ForceWitness> witness{};
  std::vector<Interval> blocking_box{};  ///< the first box that could not be decided
  bool is_inhabited = false;             ///< some pose certainly meets the constraints
  bool is_empty = false;                 ///< no pose does
  std::optional<Reason> stopped_by{};
  bool is_continued = true;  ///< false: it stopped before the tree of `from` was judged again
};

/// Receives every leaf, always in the same order, and the boxes that are left at the end.
using ForceListener = std::function<void(std::span<const Interval> box, ForceClaim claim)>;

/// Decides the question.
///
/// The boxes of a round are judged by several threads, or by workers, and concluded in order, so the
/// result does not depend on them. `progress` may be null: it receives the events of a search, with
/// Rule::kHMatrix for a feasible box, Rule::kWitness for an infeasible one, and Rule::kBlocked for
/// one that is undecided or left at the end. A search that continues tells it and the listener first
/// of all splits and leaves that were made before, in their order, after it has judged the leaves
/// again. From a tree of the same question it goes on as if it had not stopped.
///
/// Ensures   kFeasible: every box is feasible or outside, and not all are outside. kInfeasible:
///           there is a witness.
/// Throws    SavedTreeError if `from` is no tree of a search with these variables; the exceptions of
///           the workers.
[[nodiscard]] FeasibilityResult search_forces(const ForceQuestion& question,
                                              const FeasibilitySettings& settings,
                                              const ForceListener& listener, Observer* progress);

}  // namespace regulus::detail
