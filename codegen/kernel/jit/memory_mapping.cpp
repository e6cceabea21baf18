// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/memory_mapping.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <new>
#include <utility>

namespace regulus::detail {

MemoryMapping::MemoryMapping(std::size_t size) : size_(size) {
  void* pages = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) throw std::bad_alloc();
  data_ = static_cast<std::byte*>(pages);
}

MemoryMapping::~MemoryMapping() {
  if (data_) ::munmap(data_, size_);
}

MemoryMapping::MemoryMapping(MemoryMapping&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

bool MemoryMapping::seal(std::size_t offset, std::size_t size, Access access) const noexcept {
  const int rights = access == Access::kExecutable ? PROT_READ | PROT_EXEC : PROT_READ;
  return size == 0 || ::mprotect(data_ + offset, size, rights) == 0;
}

std::size_t MemoryMapping::page_size() noexcept {
  return static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace regulus::detail
