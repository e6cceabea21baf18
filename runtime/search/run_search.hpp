// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "regulus/search/observer.hpp"
#include "regulus/search/problem.hpp"
#include "regulus/search/result.hpp"

namespace regulus {

/// What resume() does once the problem is known to be free of faults.
///
/// Requires  find_fault finds none; every open box is one of the problem's; rounding to nearest.
/// Errors    std::bad_alloc before the first box and after the last; in between memory that is
///           exhausted ends the search with kMemory.
[[nodiscard, gnu::noinline]] Result run_search(const Problem& problem, const Settings& settings,
                                               std::span<const OpenBox> open,
                                               const SearchState& state, Observer* observer);

}  // namespace regulus
