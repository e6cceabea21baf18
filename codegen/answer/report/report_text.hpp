// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace regulus::detail {

/// Returns a report as text. Bytes that are not UTF-8, such as those of a path, become U+FFFD: a
/// name must not cost the verdict.
///
/// `indent`: spaces; -1: one line.
[[nodiscard]] inline std::string report_text(const nlohmann::ordered_json& report,
                                             int indent = -1) {
  return report.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace regulus::detail
