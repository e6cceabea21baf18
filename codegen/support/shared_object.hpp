// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace regulus::detail {

/// Returns the reason why a file cannot be loaded as a shared object for this processor; nullopt if
/// its headers show none.
///
/// Ensures   every segment that the system would map lies in the file. dlopen maps even a segment
///           that is cut off, and reading it ends the process with SIGBUS.
[[nodiscard]] std::optional<std::string> find_fault_in_shared_object(std::string_view bytes);

}  // namespace regulus::detail
