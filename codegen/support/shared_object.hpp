// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace regulus::inline support {

/// Why a file cannot be loaded as a shared object for this processor; nullopt if nothing in its
/// headers speaks against it.
///
/// Ensures   every segment that the system would map lies in the file. One that was cut off is
///           mapped all the same by dlopen, and ends the process with SIGBUS when it is read.
[[nodiscard]] std::optional<std::string> find_fault_in_shared_object(std::string_view bytes);

}  // namespace regulus::inline support
