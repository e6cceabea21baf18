// SPDX-License-Identifier: GPL-3.0-or-later
// Where the unknowns of a closure are looked for, in the list of all solutions.
#pragma once

#include <optional>
#include <vector>

#include "codegen/model/request.hpp"
#include "codegen/question/solve/solutions.hpp"

namespace regulus::detail {

/// Returns by how much an unknown of a closure can move without a change of the equations: by a turn,
/// if it is an angle in sines and cosines alone. 0: by nothing that is known.
[[nodiscard]] GiNaC::ex period_of(const Closure& closure, std::size_t unknown);

/// Where an unknown is looked for, and what of it counts.
struct SearchRange {
  Interval searched, range;
  Interval period{0.0};  ///< 0: the range counts
};

[[nodiscard]] SearchRange search_range(const Closure& closure, std::size_t unknown,
                                       const Interval& range);

/// Moves the values of an unknown that turns to within half a turn of 0.
void turn_back(std::vector<Interval>& values, const std::vector<SearchRange>& ranges);

/// Says of a solution whether it is within the ranges; nullopt: it certainly is not.
[[nodiscard]] std::optional<WithinLimits> place_in(const std::vector<Interval>& values,
                                                   const std::vector<SearchRange>& ranges);

}  // namespace regulus::detail
