// SPDX-License-Identifier: GPL-3.0-or-later
// Reads from the kernel what is mapped in this process.
#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace regulus::detail::test {

struct MappedRange {
  std::uintptr_t begin, end;
  std::string rights;  ///< for example "r-xp"
  std::string file;
};

inline std::vector<MappedRange> mapped_ranges() {
  std::vector<MappedRange> ranges;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::istringstream fields(line);
    MappedRange range{};
    char dash = 0;
    std::string offset, device, inode;
    fields >> std::hex >> range.begin >> dash >> range.end >> range.rights >> offset >> device >>
        inode >> range.file;
    ranges.push_back(range);
  }
  return ranges;
}

inline std::optional<MappedRange> range_of(const void* address) {
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  for (const MappedRange& range : mapped_ranges())
    if (range.begin <= at && at < range.end) return range;
  return std::nullopt;
}

/// Compares file names only, not their folders.
inline bool is_mapped(const std::string& part_of_file_name) {
  for (const MappedRange& range : mapped_ranges())
    if (range.file.find(part_of_file_name, range.file.rfind('/') + 1) != std::string::npos)
      return true;
  return false;
}

}  // namespace regulus::detail::test
