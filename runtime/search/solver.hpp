// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/problem/observer.hpp"
#include "runtime/problem/problem.hpp"
#include "runtime/problem/result.hpp"

namespace regulus {

/// Decides whether the matrix of a kernel has full column rank (α = 0), or |det J⁻¹| > α, over the
/// whole of a problem's set of motion parameters and uncertain quantities.
///
/// Requires  nothing: a faulty problem gives POSSIBLE PROBLEM, kBadProblem (see find_fault).
/// Ensures   kNoSingularity: for every variable in its true range with all constraints ≤ 0, J⁻¹ is
///           defined and of full column rank, and |det J⁻¹| > α if α > 0; it was not shown that
///           there is none (see Occupancy). kSingularity: the result's witness proves the contrary.
///           Otherwise nothing is claimed and reason and blocking_box say why. Re-entrant; the
///           caller's floating-point environment is kept.
/// Source    Merlet, T-RO 2007, Algorithm 1 and Table II.
[[nodiscard]] Result solve(const Problem& problem, const Settings& settings,
                           Observer* observer = nullptr);

/// The same, but continues from the state that an earlier search of the same problem gave its
/// observer at a pause. The caller must make sure that the state is true: it is not checked. A box
/// without the whole range of an uncertain quantity that is kept whole gives kBadProblem.
[[nodiscard]] Result resume(const Problem& problem, const Settings& settings,
                            std::span<const OpenBox> open, const SearchState& state,
                            Observer* observer = nullptr);

}  // namespace regulus
