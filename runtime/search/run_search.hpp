// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/problem/observer.hpp"
#include "runtime/problem/problem.hpp"
#include "runtime/problem/result.hpp"

namespace regulus {

/// Does the work of resume() after the problem is known to have no fault.
///
/// Requires  find_fault finds none; every open box is one of the problem's; rounding to nearest.
/// Errors    std::bad_alloc before the first box and after the last; in between memory that is
///           exhausted ends the search with kMemory.
[[nodiscard, gnu::noinline]] Result run_search(const Problem& problem, const Settings& settings,
                                               std::span<const OpenBox> open,
                                               const SearchState& state, Observer* observer);

}  // namespace regulus
