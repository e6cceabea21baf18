// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/cache/part_store.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kMostBytes = std::size_t{64} << 20;

}  // namespace

std::optional<std::string> PartStore::find(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = code_of_.find(name);
  return found == code_of_.end() ? std::nullopt : std::optional(found->second);
}

void PartStore::add(const std::string& name, const std::string& code) {
  const std::lock_guard lock(mutex_);
  if (size_ > kMostBytes) {
    code_of_.clear();
    size_ = 0;
  }
  if (code_of_.emplace(name, code).second) size_ += code.size();
}

}  // namespace regulus::detail
