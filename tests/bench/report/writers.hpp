// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "tests/bench/report/row.hpp"

namespace regulus::detail::bench {

/// Returns {"machine": {…}, "rows": [{"section", "name", "value", "unit", "ratio",
/// "ratio_quartiles", "target", "met", "explanation", "skipped"}, …]}; absent values are null.
[[nodiscard]] std::string to_json(const Report& report);

/// Returns the same as tables, one for each section.
[[nodiscard]] std::string to_markdown(const Report& report);
[[nodiscard]] std::string to_markdown(const Section& section);

/// Returns, for example, "7 of 9 targets met".
[[nodiscard]] std::string summary(const Report& report);

}  // namespace regulus::detail::bench
