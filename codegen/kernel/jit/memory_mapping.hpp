// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace regulus::detail {

/// Pages of this process: zero and writable at first, unmapped by the destructor.
class MemoryMapping {
 public:
  enum class Access { kExecutable, kReadOnly };

  /// Requires  size > 0, a multiple of page_size().
  /// Throws    std::bad_alloc if the system refuses.
  explicit MemoryMapping(std::size_t size);
  ~MemoryMapping();
  MemoryMapping(MemoryMapping&& other) noexcept;
  MemoryMapping& operator=(MemoryMapping&&) = delete;

  [[nodiscard]] std::byte* data() const noexcept { return data_; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

  /// Removes the right to write to whole pages permanently. Returns false if the system refuses.
  [[nodiscard]] bool seal(std::size_t offset, std::size_t size, Access access) const noexcept;

  [[nodiscard]] static std::size_t page_size() noexcept;

 private:
  std::byte* data_;
  std::size_t size_;
};

}  // namespace regulus::detail
