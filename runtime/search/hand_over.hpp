// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace regulus {

/// Orders the work of several threads as the standard's memory model has it: what happens before
/// give() in one thread happens before what follows take() in another, if give() came first.
/// oneTBB promises that order for a parallel loop; this says so in terms that a tool can check
/// which does not see into the library. It costs a few atomic operations a batch of boxes.
class HandOver {
 public:
  void give() noexcept { count_.fetch_add(1, std::memory_order_release); }
  void take() const noexcept { static_cast<void>(count_.load(std::memory_order_acquire)); }

 private:
  std::atomic<unsigned> count_{0};
};

}  // namespace regulus
