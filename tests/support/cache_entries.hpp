// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

namespace regulus::detail::test {

/// Returns the entries of a cache directory, without its other files.
inline std::vector<std::filesystem::path> cache_entries(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> entries;
  for (const auto& file : std::filesystem::directory_iterator(directory))
    if (file.path().extension() == ".object") entries.push_back(file.path());
  return entries;
}

}  // namespace regulus::detail::test
