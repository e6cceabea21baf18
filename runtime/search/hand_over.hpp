// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace regulus::detail {

/// Orders the work of several threads in the terms of the standard's memory model: what happens
/// before give() in one thread happens before what follows take() in another, if give() came first.
/// oneTBB promises that order for a parallel loop. Here a tool that does not see into the library
/// can check it. It costs a few atomic operations per batch of boxes.
class HandOver {
 public:
  void give() noexcept { count_.fetch_add(1, std::memory_order_release); }
  void take() const noexcept { static_cast<void>(count_.load(std::memory_order_acquire)); }

 private:
  std::atomic<unsigned> count_{0};
};

}  // namespace regulus::detail
