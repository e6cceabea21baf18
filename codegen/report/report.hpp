// SPDX-License-Identifier: GPL-3.0-or-later
// What was found, for people and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "codegen/analysis/least_singular.hpp"
#include "codegen/engine/pipeline.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::inline report {

/// The report as a JSON object. Bounds are [lo, hi]; an infinite bound is null. `nearest`: where to
/// look, when nothing was proved.
[[nodiscard]] nlohmann::ordered_json json_report(
    const PreparedSearch& preparation, const SearchOptions& search, const Result& result,
    const std::optional<LeastSingular>& nearest = std::nullopt);

/// The lines that precede the verdict on a terminal: what was asked, how it was decided, what is
/// claimed, and where it fails.
[[nodiscard]] std::string text_report(const PreparedSearch& preparation,
                                      const SearchOptions& search, const Result& result,
                                      const std::optional<LeastSingular>& nearest = std::nullopt);

/// What the verdict says about this model, in words.
[[nodiscard]] std::string claim(const PreparedSearch& preparation, const Result& result);

}  // namespace regulus::inline report
