// SPDX-License-Identifier: GPL-3.0-or-later
// The bracket, for people and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "codegen/question/margin/margin_run.hpp"

namespace regulus {

/// Returns "SAFE UP TO 0.119, NOT AT 0.134", for example.
[[nodiscard]] std::string describe_bracket(const MarginQuestion& question, const Margin& margin);

/// Returns one line about one search or witness.
[[nodiscard]] std::string format_step(const MarginStep& step);

[[nodiscard]] std::string margin_report(const PreparedSearch& preparation,
                                        const SearchOptions& search, const MarginQuestion& question,
                                        const Margin& margin);

/// Returns the part of the JSON report that is about the bracket.
[[nodiscard]] nlohmann::ordered_json json_bracket(const MarginQuestion& question,
                                                  const Margin& margin, double gap_wanted);

/// Returns the JSON report. `certified` is not above, `refuted` not below the value of its text.
/// `nominal`: the request before anything grows.
[[nodiscard]] nlohmann::ordered_json json_margin(const PreparedSearch& preparation,
                                                 const SearchOptions& search,
                                                 const Request& nominal,
                                                 const MarginQuestion& question,
                                                 const Margin& margin, double gap_wanted);

}  // namespace regulus
