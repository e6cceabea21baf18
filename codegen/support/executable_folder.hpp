// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace regulus::detail {

/// Returns the folder of the running program, with links followed; empty if it cannot be found. If
/// /proc is not mounted, uses the name that the program was started with.
[[nodiscard]] std::filesystem::path folder_of_executable();

}  // namespace regulus::detail
