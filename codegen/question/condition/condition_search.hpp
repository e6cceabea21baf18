// SPDX-License-Identifier: GPL-3.0-or-later
// Branch and bound: the largest condition number of a matrix over a variety, in the 2-norm.
#pragma once

#include <functional>
#include <optional>

#include "codegen/question/condition/box_judge.hpp"
#include "codegen/question/condition/path_judge.hpp"
#include "runtime/search/box_search.hpp"

namespace regulus::detail {

/// Facts about κ that a search starts with.
struct ConditionHint {
  bool is_singular = false;  ///< proved: at some pose of the variety
  double upper = kInfinity;  ///< proved: κ is below that everywhere
};

struct ConditionSettings : BoxSearchSettings {
  double gap = 0.01;                ///< stop when the bracket is at most this part of its upper end
  std::optional<Interval> limit{};  ///< stop when κ < limit is decided; it encloses the limit
  /// Boxes are not split in a variable narrower than this part of its range.
  double min_relative_width = 0x1p-44;
  /// Answers in another way what the search does not find out. It is asked at most once, if after
  /// some boxes no bound is known. It gets the number of seconds that are left.
  std::function<ConditionHint(double seconds)> ask{};
};

struct ConditionResult {
  double proved = kInfinity;  ///< κ < proved at every pose, for every uncertain value
  bool is_by_hint = false;    ///< `proved` is ConditionHint::upper, and not shown by the boxes
  std::optional<ConditionWitness> attained{};
  bool is_singular = false;  ///< proved by ConditionSettings::ask or by `attained`
  bool is_closed = false;    ///< the bracket is as narrow as wanted, or the limit is decided
  bool is_empty = false;     ///< the constraints exclude every pose
  bool is_continued = true;  ///< false: it stopped before the bounds of `from` were proved again
  Reason reason = Reason::kAllBoxesCertified;  ///< why it is not closed
  std::uint64_t boxes = 0;                     ///< with those of `from`
  double seconds = 0;                          ///< of this run
};

/// Splits the box with the largest bound, again and again.
///
/// The boxes of a round are judged by several threads, or by workers, and concluded in order, so the
/// result does not depend on them. `progress` may be null. It receives every split before those below it,
/// and every box that is not split as a leaf, with the rule kOutside or kSecondOrder.
/// A search that continues tells it first of all splits and leaves that were made before, in their
/// order.
///
/// Nothing in the result rests on the numbers of `from`. From a tree of the same question the search
/// goes on as if it had not stopped, with the same boxes and the same result.
///
/// Requires  the matrix of the kernel is m×n, m ≥ n, and is that whose κ is asked.
/// Throws    SavedTreeError if `from` is no tree of a search with these variables; the
///           exceptions of the workers.
[[nodiscard]] ConditionResult search_condition(const ConditionQuestion& question,
                                               const ConditionSettings& settings,
                                               Observer* progress);
/// Overload for a trajectory: the variables are those of the PathVariety.
[[nodiscard]] ConditionResult search_condition(const PathConditionQuestion& question,
                                               const ConditionSettings& settings,
                                               Observer* progress);

}  // namespace regulus::detail
