// SPDX-License-Identifier: GPL-3.0-or-later
// The largest value of f over a branch, as a bracket.
#pragma once

#include <functional>

#include "codegen/question/closure/branch_search.hpp"
#include "codegen/question/closure/value_judge.hpp"

namespace regulus::detail {

struct ValueBracket {
  double attained = -kInfinity, upper = kInfinity;  ///< of f, rounded outward
  std::optional<BranchTube>
      place{};                 ///< over the place where `attained` is; holds the configuration
  std::vector<Interval> at{};  ///< that place, by variable
  bool is_closed = false;
  std::optional<Reason> stopped_by{};
  std::uint64_t boxes = 0;
  double seconds = 0;
  BranchTree tree{};  ///< with a tube for each box of the branch
};

/// When a search has ended.
struct ValueAim {
  double gap = 0;                 ///< relative to the larger end, or to `negligible`
  double negligible = 0;          ///< if both ends are smaller
  std::optional<double> below{};  ///< a limit: it is kept, if upper is below this,
  std::optional<double> from{};   ///< or exceeded, if a value is at least that
  double attained = -kInfinity;   ///< the branch has this value elsewhere

  /// True if the search may end.
  [[nodiscard]] bool is_met(double attained_now, double upper) const;
};

/// True if values at this place, of the variables and then the unknowns, are values of the motion.
using IsPossible = std::function<bool(const std::vector<Interval>& point)>;

/// Returns the box at the tube's x₀: its coordinates there, and the ranges of the problem's tolerances.
/// None if it is not within the inner ranges, or if values of the tube over it are not possible.
[[nodiscard]] std::optional<std::vector<Interval>> possible_place(const Problem& problem,
                                                                  const BranchTube& tube,
                                                                  const IsPossible& is_possible);

/// `branch`: every box has a tube or is outside. `progress` may be null.
///
/// Throws    the exceptions of the workers.
[[nodiscard]] ValueBracket search_value(const ValueQuestion& question, const BranchTree& branch,
                                        const ValueAim& aim, const BoxSearchSettings& settings,
                                        const IsPossible& is_possible, Observer* progress);

}  // namespace regulus::detail
