// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "runtime/problem/problem.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::detail {

/// Certifies a singularity at the first of these points, or between it and one of the others.
///
/// Requires  find_fault finds none.
/// Ensures   kSingularity: the result's witness proves it, as that of `solve` does. Otherwise
///           POSSIBLE PROBLEM, kWidth, and nothing is claimed. Points are moved into the problem's
///           inner ranges. The caller's floating-point environment is kept.
[[nodiscard]] Result prove_singularity(const Problem& problem, const Settings& settings,
                                       std::span<const std::vector<double>> points);

/// Refines the singularity that a result proves by points far apart, as in the witness of an
/// exhaustive search. If that fails, the result does not change.
///
/// Requires  as prove_singularity; the result is of a search of the problem.
void close_in(const Problem& problem, const Settings& settings, Result& result);

}  // namespace regulus::detail
