// SPDX-License-Identifier: GPL-3.0-or-later
// What is told of a bracket.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "codegen/answer/facts.hpp"
#include "codegen/question/margin/margin_run.hpp"

namespace regulus::detail {

/// Returns "SAFE UP TO 0.119 cm, NOT AT 0.134 cm", for example.
/// Returns the words after a value: " cm", " times the ranges".
[[nodiscard]] std::string suffix_of_values(const MarginQuestion& question);

[[nodiscard]] std::string describe_bracket(const MarginQuestion& question, const Margin& margin);

/// Returns one line about one search or witness.
[[nodiscard]] std::string format_step(const MarginQuestion& question, const MarginStep& step);

/// Returns "tolerance of base, from 0 to 1".
[[nodiscard]] std::string describe_range(const MarginQuestion& question);
/// Tells people the poses and the uncertain values, with what grows. The motion does not follow
/// way-points.
void say_set(const Request& nominal, const MarginQuestion& question, Facts& facts);
/// Tells the bracket to programs: `claim`, `verdict`, both ends, the steps.
void add_bracket(const MarginQuestion& question, const Margin& margin, Facts& facts);
/// Tells people what is claimed at an end.
void say_end(const MarginQuestion& question, const std::optional<MarginStep>& step, Facts& facts);
void tell_gap(const Margin& margin, double gap_wanted, Facts& facts);

/// Tells the bracket, its ends and the searches. `nominal`: the request before anything grows.
void tell_margin(const PreparedSearch& preparation, const SearchOptions& search,
                 const Request& nominal, const MarginQuestion& question, const Margin& margin,
                 double gap_wanted, Facts& facts);

}  // namespace regulus::detail
