// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes are the entry of a key only if they were written for that key.
#include "codegen/kernel/jit/cache/cache_entry.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace regulus;
  using namespace regulus::detail;
  const std::string key(64, 'a');
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  if (const auto object = open_cache_entry(key, bytes)) {
    const CacheEntryHeader header = make_cache_entry_header(key, *object);
    const std::string again(reinterpret_cast<const char*>(&header), sizeof header);
    if (again + *object != bytes) std::abort();
  }
  return 0;
}
