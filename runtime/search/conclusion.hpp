// SPDX-License-Identifier: Apache-2.0
// What follows from a whole search besides its leaves: whether the claim is about any pose at all,
// and whether algebra knows that every pose is singular.
#pragma once

#include "runtime/problem/problem.hpp"
#include "runtime/problem/result.hpp"

namespace regulus {

/// Some box was certified, by a test or by a filter.
[[nodiscard]] bool certified_somewhere(const Statistics& statistics) noexcept;

/// There are leaves, and a constraint excludes each of them.
[[nodiscard]] bool excluded_everywhere(const Statistics& statistics) noexcept;

/// Fills in `occupancy` and `inhabitant`, and turns the verdict
/// - into POSSIBLE PROBLEM, kEmptyVariety, if the constraints exclude every pose;
/// - into SINGULARITY, kAlwaysSingular, if Settings::algebra says that det A is the zero function
///   and a point of the variety is certainly inside the constraints and defined: the witness. What
///   a search was asked under is at AlgebraOracle.
///
/// Requires  verdict, reason, statistics and stopped_by are those of a search of the problem;
///           rounding to nearest.
void complete(Result& result, const Problem& problem, const Settings& settings);

}  // namespace regulus
