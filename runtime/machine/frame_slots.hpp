// SPDX-License-Identifier: Apache-2.0
// Room for the values of a function that runs: on the stack of its thread, unless they are very
// many.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>

#include "runtime/kernel/abi.hpp"
#include "runtime/machine/step.hpp"

namespace regulus::machine {

/// The most slots that a frame has on the stack: 1 MiB of them.
inline constexpr std::size_t kMaxStackSlots = 8192;

template <std::size_t slots, class Run>
[[gnu::noinline]] unsigned run_with(const Run& run) noexcept {
  Slot values[slots];  // not initialised: every value is written before it is read
  return run(&values[0]);
}

/// Functions of so many values are those of large matrices, which take longer than an allocation.
template <class Run>
[[gnu::noinline]] unsigned run_on_heap(std::size_t count, const Run& run) noexcept {
  constexpr unsigned kNothingIsDefined = (1U << REGULUS_LANES) - 1;
  const std::unique_ptr<void, decltype(&std::free)> memory(
      std::aligned_alloc(alignof(Slot), count * sizeof(Slot)), &std::free);
  return memory == nullptr ? kNothingIsDefined : run(static_cast<Slot*>(memory.get()));
}

/// What run(Slot*) returns, which has `count` slots while it runs. Where memory is exhausted: that
/// no lane is defined, from which nothing follows.
template <class Run>
unsigned with_slots(std::size_t count, const Run& run) noexcept {
  if (count <= 64) return run_with<64>(run);
  if (count <= 256) return run_with<256>(run);
  if (count <= 1024) return run_with<1024>(run);
  if (count <= kMaxStackSlots) return run_with<kMaxStackSlots>(run);
  return run_on_heap(count, run);
}

}  // namespace regulus::machine
