// SPDX-License-Identifier: GPL-3.0-or-later
// Limits of a TOML text, checked before the TOML library reads it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace regulus::detail {

// The library builds nested tables, one for each part of a key, and destroys them by recursion; and
// it looks each part up in a list of all tables. No model comes near these limits.
constexpr std::size_t kMaxKeyParts = 16;        ///< of a key or a table's name: a.b.c has three
constexpr std::size_t kMaxTomlNesting = 32;     ///< of [ ] and { } in a value
constexpr std::size_t kMaxTomlTables = 20'000;  ///< parts of all dotted keys and table names

/// Throws InputError with file and line for a text beyond these limits. It checks nothing else: a
/// text that is not TOML passes. Takes linear time and no recursion.
void require_toml_limits(std::string_view text, const std::string& file);

}  // namespace regulus::detail
