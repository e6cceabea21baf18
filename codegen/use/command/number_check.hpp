// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of the numbers of options. Their messages say what was found and what can be written.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

namespace regulus::detail {

/// A decimal above 0, in seconds.
[[nodiscard]] CLI::Validator positive_seconds();
/// A decimal of at least 0. `what`: such as "a number of seconds".
[[nodiscard]] CLI::Validator number_from_zero(const std::string& what);
[[nodiscard]] CLI::Validator whole_number(std::uint64_t least, std::uint64_t most = UINT64_MAX);
/// Takes "64MB" for its number of bytes.
[[nodiscard]] CLI::Validator size_in_bytes(std::uint64_t least, std::uint64_t most);

}  // namespace regulus::detail
