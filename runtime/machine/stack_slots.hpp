// SPDX-License-Identifier: Apache-2.0
// Room for the values of a function that runs, on the stack of its thread.
#pragma once

#include <cstddef>

#include "regulus/machine/step.hpp"

namespace regulus::machine {

/// The most slots that a frame has: 1 MiB of them.
inline constexpr std::size_t kMaxFrameSlots = 8192;

template <std::size_t slots, class Run>
[[gnu::noinline]] unsigned run_with(const Run& run) noexcept {
  Slot values[slots];  // not initialised: every value is written before it is read
  return run(&values[0]);
}

/// What run(Slot*) returns, which has `count` slots while it runs.
///
/// Requires  count ≤ kMaxFrameSlots.
template <class Run>
unsigned with_slots(std::size_t count, const Run& run) noexcept {
  if (count <= 64) return run_with<64>(run);
  if (count <= 256) return run_with<256>(run);
  if (count <= 1024) return run_with<1024>(run);
  return run_with<kMaxFrameSlots>(run);
}

}  // namespace regulus::machine
