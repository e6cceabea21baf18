// SPDX-License-Identifier: GPL-3.0-or-later
// The directory of cached machine code, which no other user can write to.
#pragma once

#include <filesystem>
#include <string>

#include "codegen/support/file_descriptor.hpp"

namespace regulus::detail {

/// Returns $XDG_CACHE_HOME/regulus, or ~/.cache/regulus; empty if neither variable is an absolute
/// path.
[[nodiscard]] std::filesystem::path default_cache_directory();

/// An open directory, or the reason why there is none.
struct CacheDirectory {
  FileDescriptor descriptor;
  std::string refusal;  ///< empty if the directory is open
};

/// Opens the directory; creates it with mode 0700 if it does not exist.
///
/// Ensures   the open directory is not a symbolic link, belongs to the effective user and is
///           writable by no other user. The checks are made on the descriptor, so a later exchange
///           of the directory has no effect.
[[nodiscard]] CacheDirectory open_cache_directory(const std::filesystem::path& directory);

}  // namespace regulus::detail
