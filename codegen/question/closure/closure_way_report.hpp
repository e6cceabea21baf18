// SPDX-License-Identifier: GPL-3.0-or-later
// Tells the answer about a branch along way-points.
#pragma once

#include <string>

#include "codegen/answer/facts.hpp"
#include "codegen/question/closure/closure_way_paving.hpp"
#include "codegen/question/margin/margin_run.hpp"

namespace regulus::detail {

/// Returns the claim, or why there is none, in words.
[[nodiscard]] std::string describe_claim(const PreparedWay& prepared, const WayFinding& found);

/// Returns the set that claims are about, in words.
[[nodiscard]] std::string words_of_segments(const PreparedWay& prepared);

/// Tells the question, and where the branch begins.
void tell_way_question(const PreparedWay& prepared, const WayFinding& found, Facts& facts);

void tell_closure_way(const PreparedWay& prepared, const SearchOptions& search,
                      const WayFinding& found, Facts& facts);

/// Tells the question, the stretches and the share of each claim, and where the branch ends.
void tell_way_paving(const PreparedWay& prepared, const SearchOptions& search, double resolution,
                     const WayFinding& found, const std::vector<PathStretch>& stretches,
                     Facts& facts);

/// Tells a bracket, and the check of one of its values.
void tell_way_margin(const PreparedWay& prepared, const SearchOptions& search,
                     const WayFinding& found, const MarginQuestion& question, const Margin& margin,
                     double gap_wanted, Facts& facts);

}  // namespace regulus::detail
