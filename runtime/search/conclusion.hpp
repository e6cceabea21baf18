// SPDX-License-Identifier: Apache-2.0
// The conclusions of a whole search, besides those of its leaves: is the claim about any pose at
// all, and does algebra show that every pose is singular.
#pragma once

#include "runtime/problem/problem.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::detail {

/// Returns true if some box was certified, by a test or by a filter.
[[nodiscard]] bool certified_somewhere(const Statistics& statistics) noexcept;

/// Returns true if there are leaves, and a constraint excludes each of them.
[[nodiscard]] bool excluded_everywhere(const Statistics& statistics) noexcept;

/// Fills in `occupancy` and `inhabitant`, and changes the verdict
/// - to POSSIBLE PROBLEM, kEmptyVariety, if the constraints exclude every pose;
/// - to SINGULARITY, kAlwaysSingular, if Settings::algebra says that det A is the zero function
///   and a point of the variety is certainly inside the constraints and defined: the witness.
///   AlgebraOracle has the conditions under which a search asks it;
/// - to SINGULARITY, if it finds a singular place that it knows exactly.
///
/// Requires  verdict, reason, statistics and stopped_by are those of a search of the problem;
///           rounding to nearest.
void complete(Result& result, const Problem& problem, const Settings& settings);

}  // namespace regulus::detail
