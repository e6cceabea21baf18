// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "tests/bench/report/row.hpp"

namespace regulus::bench {

/// {"machine": {…}, "rows": [{"section", "name", "value", "unit", "ratio", "ratio_quartiles",
/// "target", "met", "explanation", "skipped"}, …]}; what a row lacks is null.
[[nodiscard]] std::string to_json(const Report& report);

/// The same as tables, one for each section.
[[nodiscard]] std::string to_markdown(const Report& report);
[[nodiscard]] std::string to_markdown(const Section& section);

/// "7 of 9 targets met".
[[nodiscard]] std::string summary(const Report& report);

}  // namespace regulus::bench
