// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "codegen/kernel/cpp/generate.hpp"

namespace regulus::detail {

/// Throws FileError if no file can be made in the folder, or no folder in its place.
void require_room_in(const std::filesystem::path& folder);

/// Writes the files into the folder; creates it if necessary.
///
/// Ensures   no file is ever visible half-written; if it throws, none has been replaced, unless the
///           file system fails between one renaming and the next.
/// Throws    FileError.
void write_files(const std::filesystem::path& folder, const std::vector<GeneratedFile>& files);

/// Returns the rule for `make` and Ninja that the files in the folder depend on the input.
///
/// Throws    FileError for a path with a line break, which no rule can name.
[[nodiscard]] std::string dependency_text(const std::filesystem::path& folder,
                                          const std::vector<GeneratedFile>& files,
                                          const std::string& input);

}  // namespace regulus::detail
