// SPDX-License-Identifier: GPL-3.0-or-later
// What is asked of a TOML text before the TOML library sees it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace regulus::inline model {

// The library builds a table for each part of a key, one in the other, and takes them apart by
// recursion; and it looks each part up in a list of all tables. No model needs as much as this.
constexpr std::size_t kMaxKeyParts = 16;        ///< of a key or a table's name: a.b.c has three
constexpr std::size_t kMaxTomlNesting = 32;     ///< of [ ] and { } in a value
constexpr std::size_t kMaxTomlTables = 20'000;  ///< parts of all dotted keys and table names

/// Throws InputError with file and line for a text beyond these limits. Nothing else is looked at:
/// what is no TOML passes. Takes linear time and no stack.
void require_toml_limits(std::string_view text, const std::string& file);

}  // namespace regulus::inline model
