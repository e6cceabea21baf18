// SPDX-License-Identifier: GPL-3.0-or-later
// Machine code kept between runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/kernel/jit/cache/cache_directory.hpp"

namespace regulus::detail {

/// A directory of objects and other results, each in a file named by its key. Any number of
/// processes may use it at once: an entry appears whole or not at all, and one process replaces
/// another's equal entry.
///
/// An entry that is truncated, altered, of another format, or that another user could have written
/// is treated as absent. The hash inside an entry shows damage; the ownership and mode of the
/// directory and of the entry prevent other users from writing.
class ObjectCache {
 public:
  static constexpr std::uint64_t kDefaultLimit = std::uint64_t{256} << 20;

  /// `limit`: bytes that all entries may take; the least recently used ones go first. The entries
  /// are counted only after a sixteenth of the limit has been written.
  explicit ObjectCache(const std::filesystem::path& directory, std::uint64_t limit = kDefaultLimit);

  /// Returns the reason why the directory cannot be used; empty if it can. If it cannot, reading
  /// finds nothing and writing does nothing.
  [[nodiscard]] const std::string& refusal() const noexcept { return directory_.refusal; }

  struct Entry {
    std::optional<std::string> object;
    std::string note;  ///< why an existing file was not used; otherwise empty
  };

  /// Requires  key is 64 hexadecimal digits.
  [[nodiscard]] Entry read(std::string_view key) const;

  /// Returns the reason why the entry could not be written; empty if it was.
  /// Requires  key is 64 hexadecimal digits.
  std::string write(std::string_view key, std::string_view object) const;

  struct NamedObject {
    std::string_view key, object;
  };
  /// The same for several entries.
  std::string write(const std::vector<NamedObject>& objects) const;

 private:
  [[nodiscard]] std::string write_entry(const NamedObject& object) const;

  CacheDirectory directory_;
  std::uint64_t limit_;
};

}  // namespace regulus::detail
