// SPDX-License-Identifier: GPL-3.0-or-later
// The bracket, for people and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "regulus/codegen/driver/margin_run.hpp"

namespace regulus::codegen {

/// "SAFE UP TO 0.119, NOT AT 0.134"
[[nodiscard]] std::string bracket_words(const MarginQuestion& question, const Margin& margin);

/// One line about one search or witness.
[[nodiscard]] std::string step_line(const MarginStep& step);

[[nodiscard]] std::string margin_report(const Preparation& preparation, const SearchOptions& search,
                                        const MarginQuestion& question, const Margin& margin);

/// `certified` is not above, `refuted` not below the value that its text denotes.
[[nodiscard]] nlohmann::ordered_json json_margin(const Preparation& preparation,
                                                 const SearchOptions& search,
                                                 const MarginQuestion& question,
                                                 const Margin& margin, double gap_wanted);

}  // namespace regulus::codegen
