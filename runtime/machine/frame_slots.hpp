// SPDX-License-Identifier: Apache-2.0
// Memory for the values of a function that runs: on the stack of its thread, unless there are very
// many values.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>

#include "runtime/kernel/abi.hpp"
#include "runtime/machine/step.hpp"

namespace regulus::detail::machine {

/// The most slots of a frame on the stack: 1 MiB.
inline constexpr std::size_t kMaxStackSlots = 8192;

template <std::size_t slots, class Run>
[[gnu::noinline]] unsigned run_with(const Run& run) noexcept {
  Slot values[slots];  // not initialised: every value is written before it is read
  return run(&values[0]);
}

/// Functions with so many values belong to large matrices; they take longer than an allocation.
template <class Run>
[[gnu::noinline]] unsigned run_on_heap(std::size_t count, const Run& run) noexcept {
  constexpr unsigned kNothingIsDefined = (1U << REGULUS_LANES) - 1;
  const std::unique_ptr<void, decltype(&std::free)> memory(
      std::aligned_alloc(alignof(Slot), count * sizeof(Slot)), &std::free);
  return memory == nullptr ? kNothingIsDefined : run(static_cast<Slot*>(memory.get()));
}

/// Returns the result of run(Slot*), which has `count` slots while it runs. If memory is exhausted,
/// returns that no lane is defined; nothing follows from that.
template <class Run>
unsigned with_slots(std::size_t count, const Run& run) noexcept {
  if (count <= 64) return run_with<64>(run);
  if (count <= 256) return run_with<256>(run);
  if (count <= 1024) return run_with<1024>(run);
  if (count <= kMaxStackSlots) return run_with<kMaxStackSlots>(run);
  return run_on_heap(count, run);
}

}  // namespace regulus::detail::machine
