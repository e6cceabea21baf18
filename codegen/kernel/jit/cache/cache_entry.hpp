// SPDX-License-Identifier: GPL-3.0-or-later
// The file format of a cached object: a header of fixed size, then the object.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace regulus::detail {

/// Shape     no padding: the bytes in memory are the bytes in the file.
struct CacheEntryHeader {
  std::array<char, 16> magic;
  std::uint64_t version;
  std::array<char, 64> key;     ///< the key of the object's inputs
  std::uint64_t size;           ///< of the object
  std::array<char, 64> digest;  ///< SHA-256 of the object
};
static_assert(sizeof(CacheEntryHeader) == 16 + 8 + 64 + 8 + 64);

/// Requires  key is 64 characters.
[[nodiscard]] CacheEntryHeader make_cache_entry_header(std::string_view key,
                                                       std::string_view object);

/// Returns the object of the entry, or nullopt unless the bytes are an unaltered entry for this
/// key.
[[nodiscard]] std::optional<std::string> open_cache_entry(std::string_view key,
                                                          std::string_view bytes);

}  // namespace regulus::detail
