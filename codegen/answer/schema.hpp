// SPDX-License-Identifier: GPL-3.0-or-later
// What other programs read about the JSON reports, from the table of keys.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace regulus::detail {

/// Returns the JSON schema of the reports and of errors: `$defs` has one for each kind.
[[nodiscard]] nlohmann::ordered_json json_schema();

/// Returns the types of the reports for TypeScript.
[[nodiscard]] std::string typescript_types();

/// Returns the types of the reports for Python: a module of TypedDicts.
[[nodiscard]] std::string python_types();

}  // namespace regulus::detail
