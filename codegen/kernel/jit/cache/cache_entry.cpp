// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/cache/cache_entry.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "runtime/files/sha256.hpp"

namespace regulus::detail {
namespace {

constexpr std::string_view kMagic = "regulus object\n";
constexpr std::uint64_t kVersion = 1;

template <std::size_t N>
void assign(std::array<char, N>& field, std::string_view text) {
  if (text.size() > N) throw std::invalid_argument("a field of a cache entry is too long");
  field.fill(0);
  std::ranges::copy(text, field.begin());
}

}  // namespace

CacheEntryHeader make_cache_entry_header(std::string_view key, std::string_view object) {
  CacheEntryHeader header{};
  assign(header.magic, kMagic);
  header.version = kVersion;
  assign(header.key, key);
  header.size = object.size();
  assign(header.digest, sha256(object));
  return header;
}

std::optional<std::string> open_cache_entry(std::string_view key, std::string_view bytes) {
  if (bytes.size() < sizeof(CacheEntryHeader)) return std::nullopt;
  const std::string_view object = bytes.substr(sizeof(CacheEntryHeader));
  const CacheEntryHeader expected = make_cache_entry_header(key, object);
  if (std::memcmp(bytes.data(), &expected, sizeof expected) != 0) return std::nullopt;
  return std::string(object);
}

}  // namespace regulus::detail
