// SPDX-License-Identifier: GPL-3.0-or-later
// A finding says whether |det Φ_p| is more than a threshold all over a branch.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "codegen/question/closure/value_paving.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::detail {

/// A configuration of the branch where the threshold is not exceeded.
struct PlaceBelow {
  std::size_t piece = 0;
  std::vector<Interval> place;                  ///< by variable
  std::vector<Interval> unknowns;               ///< encloses the configuration
  Interval determinant{-kInfinity, kInfinity};  ///< encloses det Φ_p there
};

struct ThresholdFinding {
  Verdict verdict = Verdict::kPossibleProblem;
  std::string reason{};               ///< why neither was shown; otherwise empty
  std::vector<BranchTree> trees{};    ///< of a check that shows it: by piece
  std::vector<BranchPaving> paved{};  ///< of a paving: the pieces that were reached
  std::optional<PlaceBelow> below{};
  std::optional<Reason> stopped_by{};
  std::uint64_t boxes = 0;
  double seconds = 0;
};

}  // namespace regulus::detail
