// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/question/engine/options.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus::detail {

/// Returns the settings of a search. Throws UsageError for a value that is not in its enumeration,
/// or an unknown ingredient.
[[nodiscard]] Settings settings_from(const SearchOptions& options);

/// Returns a weight for each variable: that of SearchOptions::weights, or 1. Empty: there are none.
///
/// Throws    UsageError for another name or number, and with another choice of the range that is split.
[[nodiscard]] std::vector<double> weights_of(const ReportLabels& labels,
                                             const SearchOptions& options);

/// The same with the weights, the rest of the time limit, the loaded filters, and the interrupt.
[[nodiscard]] Settings settings_of(const PreparedSearch& prepared, const SearchOptions& options,
                                   const std::atomic<bool>* interrupt);

}  // namespace regulus::detail
