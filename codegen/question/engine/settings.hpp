// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/question/engine/options.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus {

/// Returns the settings of a search. Throws UsageError for a value that is not in its enumeration,
/// or an unknown ingredient.
[[nodiscard]] Settings settings_from(const SearchOptions& options);

/// The same with the rest of the time limit, the loaded filters, and the interrupt.
[[nodiscard]] Settings settings_of(const PreparedSearch& prepared, const SearchOptions& options,
                                   const std::atomic<bool>* interrupt);

}  // namespace regulus
