// SPDX-License-Identifier: GPL-3.0-or-later
// Reports of a check, for people and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "codegen/answer/facts.hpp"
#include "codegen/question/analysis/least_singular.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::detail {

/// Tells the question, the method, the claim, and the place where it fails. `nearest`: the pose to look
/// at, if nothing was proved.
void tell_report(const PreparedSearch& preparation, const SearchOptions& search,
                 const Result& result, const std::optional<LeastSingular>& nearest, Facts& facts);

/// Tells the numbers of boxes.
void tell_boxes(const Statistics& statistics, Facts& facts);

/// Returns the number of leaves by their rule.
[[nodiscard]] nlohmann::ordered_json json_leaves(const Statistics& statistics);

/// Returns the report as a JSON object. Bounds are [lo, hi]; an infinite bound is null.
[[nodiscard]] nlohmann::ordered_json json_report(
    const PreparedSearch& preparation, const SearchOptions& search, const Result& result,
    const std::optional<LeastSingular>& nearest = std::nullopt);

/// Returns the lines before the verdict on a terminal.
[[nodiscard]] std::string text_report(const PreparedSearch& preparation,
                                      const SearchOptions& search, const Result& result,
                                      const std::optional<LeastSingular>& nearest = std::nullopt);

/// Returns the claim of the verdict about this model, in words.
[[nodiscard]] std::string claim(const PreparedSearch& preparation, const Result& result);

}  // namespace regulus::detail
