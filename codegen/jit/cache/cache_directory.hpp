// SPDX-License-Identifier: GPL-3.0-or-later
// The directory that cached machine code is read from: one that nobody else can write to.
#pragma once

#include <filesystem>
#include <string>

#include "codegen/support/file_descriptor.hpp"

namespace regulus::inline jit {

/// $XDG_CACHE_HOME/regulus, or ~/.cache/regulus; empty when neither variable holds an absolute
/// path.
[[nodiscard]] std::filesystem::path default_cache_directory();

/// An open directory, or the reason why there is none.
struct CacheDirectory {
  FileDescriptor descriptor;
  std::string refusal;  ///< empty when the directory is open
};

/// Opens the directory, creating it with mode 0700 when it does not exist.
///
/// Ensures   the open directory is itself no symbolic link, belongs to the effective user and is
///           writable by nobody else. What was checked is the descriptor, so that exchanging the
///           directory afterwards changes nothing.
[[nodiscard]] CacheDirectory open_cache_directory(const std::filesystem::path& directory);

}  // namespace regulus::inline jit
