// SPDX-License-Identifier: GPL-3.0-or-later
// This malloc and pthread_mutex_lock replace those of the C library; they count and call them.
#include "counted_calls.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>
#include <cstdlib>
#include <mutex>

namespace {
std::atomic<std::uint64_t> allocation_count{0}, lock_count{0};
}

namespace regulus::detail::test {
std::uint64_t allocations() noexcept { return allocation_count; }
std::uint64_t locks() noexcept { return lock_count; }
}  // namespace regulus::detail::test

#if !defined(__SANITIZE_ADDRESS__)
extern "C" {

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) {
  ++allocation_count;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocation_count;
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  ++allocation_count;
  return __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocation_count;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  ++allocation_count;
  *block = __libc_memalign(alignment, size);
  return *block == nullptr ? 12 : 0;
}

int pthread_mutex_lock(pthread_mutex_t* mutex) {
  ++lock_count;
  using Lock = int (*)(pthread_mutex_t*);
  static const Lock next = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  return next(mutex);
}

}  // extern "C"
#endif

namespace regulus::detail {
namespace {

TEST(CountedCalls, SeeWhatIsAllocatedAndLocked) {
  if (!test::kCallsAreCounted) GTEST_SKIP() << "a sanitizer owns the allocator";
  const std::uint64_t allocations = test::allocations(), locks = test::locks();
  std::mutex mutex;
  const std::lock_guard guard(mutex);
  // A compiler may remove the allocation of a new-expression, but not these calls.
  constexpr std::align_val_t kWide{64};
  ::operator delete(::operator new(64, kWide), kWide);
  ::operator delete(::operator new(4));
  EXPECT_GE(test::allocations(), allocations + 2);
  EXPECT_GE(test::locks(), locks + 1);
}

}  // namespace
}  // namespace regulus::detail
