// SPDX-License-Identifier: GPL-3.0-or-later
// A search that runs out of memory reports this. The kernel is a plain function, so that only the
// search asks for memory.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "runtime/search/solver.hpp"
#include "tests/unit/embedded/static_kernel.hpp"

namespace {

/// The number of allocations that will succeed; negative: all.
std::atomic<long> allocations_left = -1;
std::atomic<bool> refused = false;
/// If true, only one allocation is refused.
std::atomic<bool> once = false;

}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
  const long left = allocations_left.load();
  if (left > 0) allocations_left = left - 1;
  if (left == 0) {
    refused = true;
    if (once) allocations_left = -1;
    throw std::bad_alloc();
  }
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace regulus::detail {
namespace {

/// Refuses one allocation, or that one and all later ones.
enum class Shortage { kOnce, kForGood };

class ShortOfMemory final : public Observer {
 public:
  ShortOfMemory(long allocations, Shortage shortage) : allocations_(allocations) {
    refused = false;
    once = shortage == Shortage::kOnce;
  }
  ShortOfMemory(const ShortOfMemory&) = delete;
  ShortOfMemory& operator=(const ShortOfMemory&) = delete;
  ~ShortOfMemory() override { allocations_left = -1; }

  void on_start(const Problem&, const Settings&) noexcept override {
    allocations_left = allocations_;
  }
  void on_open(const OpenBox&) noexcept override { ++open_; }
  void on_finish(const Result&) noexcept override { allocations_left = -1; }

  [[nodiscard]] std::size_t open() const noexcept { return open_; }

 private:
  long allocations_;
  std::size_t open_ = 0;
};

/// Makes a problem with det A = x + u, which vanishes in the middle of the ranges.
Problem format_singular(const regulus_kernel& kernel) {
  Problem problem;
  problem.kernel = &kernel;
  problem.outer = {{-1, 1}, {0, 1}, {-0x1p-8, 0x1p-8}};
  problem.inner.assign(problem.outer.begin(), problem.outer.end());
  return problem;
}

Settings paving() {
  Settings settings;
  settings.exhaustive = true;
  settings.min_relative_width = 0x1p-4;
  settings.threads = 1;
  return settings;
}

TEST(Memory, ASearchThatRunsOutOfItEndsWithThatReason) {
  const double r = 0;
  const regulus_kernel kernel = test::static_kernel(test::line_matrix, 1, &r);
  const Problem problem = format_singular(kernel);
  const Settings settings = paving();
  std::size_t reported = 0;
  for (const Shortage shortage : {Shortage::kOnce, Shortage::kForGood})
    for (long allocations = 0; allocations < 10000; ++allocations) {
      ShortOfMemory memory(allocations, shortage);
      try {
        const Result result = solve(problem, settings, &memory);
        EXPECT_NE(result.verdict, Verdict::kNoSingularity);
        if (result.stopped_by == Reason::kMemory) {
          ++reported;
          EXPECT_GT(memory.open(), 0U);
        }
      } catch (const std::bad_alloc&) {  // from code before or after the search
      }
      if (!refused) break;
    }
  EXPECT_GT(reported, 0U);
}

TEST(Memory, SearchesForAWitnessNeedNoneOnTheWay) {
  const double r = 0;
  const regulus_kernel kernel = test::static_kernel(test::line_matrix, 1, &r);
  const Problem problem = format_singular(kernel);
  Settings settings;
  settings.threads = 1;
  for (long allocations = 0; allocations < 10000; ++allocations) {
    ShortOfMemory memory(allocations, Shortage::kForGood);
    try {
      EXPECT_NE(solve(problem, settings, &memory).verdict, Verdict::kNoSingularity);
    } catch (const std::bad_alloc&) {
    }
    if (!refused) return;
  }
  FAIL() << "the search never ended";
}

}  // namespace
}  // namespace regulus::detail
