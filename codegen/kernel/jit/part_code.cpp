// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/part_code.hpp"

#include <algorithm>
#include <cstring>

#include "codegen/kernel/jit/load_error.hpp"
#include "codegen/kernel/jit/part.hpp"

namespace regulus::detail {
namespace {

std::size_t round_up(std::size_t value, std::size_t alignment) {
  return (value + alignment - 1) / alignment * alignment;
}

/// Returns the begin of each code, and last the end of all, in whole pages.
std::vector<std::size_t> offsets_of(const std::vector<std::string>& codes) {
  std::vector<std::size_t> offsets{0};
  for (const std::string& code : codes)
    offsets.push_back(round_up(offsets.back() + code.size(), kCodeAlignment));
  offsets.back() = round_up(std::max<std::size_t>(offsets.back(), 1), MemoryMapping::page_size());
  return offsets;
}

}  // namespace

LoadedParts::LoadedParts(const std::vector<std::string>& codes)
    : offsets_(offsets_of(codes)), mapping_(offsets_.back()) {
  for (std::size_t i = 0; i < codes.size(); ++i)
    std::memcpy(mapping_.data() + offsets_[i], codes[i].data(), codes[i].size());
  if (!mapping_.seal(0, mapping_.size(), MemoryMapping::Access::kExecutable))
    throw LoadError("the system refuses executable memory");
}

PartFunction LoadedParts::function(std::size_t part) const noexcept {
  return reinterpret_cast<PartFunction>(mapping_.data() + offsets_[part]);
}

}  // namespace regulus::detail
