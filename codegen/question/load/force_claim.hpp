// SPDX-License-Identifier: GPL-3.0-or-later
// These claims about forces are made for a motion, or for one box.
#pragma once

#include <cstdint>

namespace regulus {

enum class FeasibilityVerdict : std::uint8_t { kFeasible, kInfeasible, kPossibleProblem };

/// Returns "FEASIBLE", "INFEASIBLE" or "POSSIBLE PROBLEM".
[[nodiscard]] const char* name(FeasibilityVerdict verdict) noexcept;

/// The claim about a box.
enum class ForceClaim : std::uint8_t {
  kFeasible,    ///< at every pose of the box the load is held
  kInfeasible,  ///< at no pose of it some load is held
  kUndecided,
  kOutside,  ///< a constraint excludes every pose of the box
};

/// Returns the word of JSON lines: "feasible", "infeasible", "undecided", "outside".
[[nodiscard]] const char* name(ForceClaim claim) noexcept;

}  // namespace regulus
