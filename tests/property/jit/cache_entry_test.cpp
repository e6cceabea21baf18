// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/cache/cache_entry.hpp"

#include <gtest/gtest.h>

namespace regulus::detail {
namespace {

const std::string kKey(64, 'a');

std::string entry_of(const std::string& object) {
  const CacheEntryHeader header = make_cache_entry_header(kKey, object);
  return std::string(reinterpret_cast<const char*>(&header), sizeof header) + object;
}

TEST(CacheEntry, OpensForItsKeyOnly) {
  for (const std::string& object :
       {std::string(), std::string("\0\1\2", 3), std::string(5000, 'x')}) {
    EXPECT_EQ(open_cache_entry(kKey, entry_of(object)), object);
    EXPECT_EQ(open_cache_entry(std::string(64, 'b'), entry_of(object)), std::nullopt);
  }
}

TEST(CacheEntry, DoesNotOpenWithAnyBitFlipped) {
  const std::string sound = entry_of("some machine code");
  for (std::size_t bit = 0; bit < 8 * sound.size(); ++bit) {
    std::string altered = sound;
    altered[bit / 8] = static_cast<char>(altered[bit / 8] ^ (1 << bit % 8));
    EXPECT_EQ(open_cache_entry(kKey, altered), std::nullopt) << bit;
  }
}

TEST(CacheEntry, DoesNotOpenWithBytesMissingOrAdded) {
  const std::string sound = entry_of("some machine code");
  for (std::size_t size = 0; size < sound.size(); ++size)
    EXPECT_EQ(open_cache_entry(kKey, sound.substr(0, size)), std::nullopt) << size;
  EXPECT_EQ(open_cache_entry(kKey, sound + '\0'), std::nullopt);
}

}  // namespace
}  // namespace regulus::detail
