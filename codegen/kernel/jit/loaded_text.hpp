// SPDX-License-Identifier: GPL-3.0-or-later
// A compiled text in memory.
#pragma once

#include <cstddef>
#include <string_view>
#include <utility>

#include "codegen/kernel/jit/clang_interface.h"

namespace regulus::detail {

/// Code readable and executable, constants read-only, variables writable, and nothing ever writable
/// and executable at once. Unmapped by the destructor.
class LoadedText {
 public:
  explicit LoadedText(regulus_loaded loaded) noexcept : loaded_(loaded) {}
  ~LoadedText() {
    if (loaded_.state) loaded_.unload(loaded_.state);
  }
  LoadedText(LoadedText&& other) noexcept : loaded_(std::exchange(other.loaded_, {})) {}
  LoadedText& operator=(LoadedText&&) = delete;

  /// Returns the address of a global symbol with at least `size` bytes; null if there is none.
  [[nodiscard]] void* find(std::string_view name, std::size_t size = 1) const noexcept {
    return loaded_.find(loaded_.state, {name.data(), name.size()}, size);
  }

 private:
  regulus_loaded loaded_;
};

}  // namespace regulus::detail
