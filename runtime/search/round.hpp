// SPDX-License-Identifier: Apache-2.0
// Batches of boxes that are decided together, by one thread or several.
//
// How many there are is for the search to say and does not depend on the threads; each batch is
// decided by itself; what follows from it is drawn afterwards, batch by batch, by one thread. So
// everything a search does is the same for any number of threads.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <vector>

#include "runtime/search/decider.hpp"

namespace regulus {

class Round {
 public:
  using Clock = std::chrono::steady_clock;

  /// All three must outlive it. Past `deadline`, or when interrupted, batches after the first are
  /// left as they are.
  Round(const Problem& problem, const Settings& settings, const RowStructure& structure,
        Clock::time_point deadline);
  ~Round();

  void clear() noexcept { size_ = 0; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// One more batch, without boxes; null when memory is exhausted.
  [[nodiscard]] Decisions* append() noexcept;
  [[nodiscard]] Decisions& batch(std::size_t index) noexcept { return *batches_[index]; }

  /// Decides every batch that has boxes.
  ///
  /// Ensures   false: memory was exhausted, and some batches are left as they are.
  [[nodiscard]] bool decide(const AdaptiveThreshold& threshold) noexcept;

  [[nodiscard]] const Bisector& bisector() const noexcept { return deciders_.front()->bisector(); }

 private:
  class Threads;
  void decide(Decider& decider, std::size_t index) noexcept;
  void decide_in_parallel();
  [[nodiscard]] bool must_stop() const noexcept;

  const Problem& problem_;
  const Settings& settings_;
  const RowStructure& structure_;
  const Clock::time_point deadline_;
  const unsigned thread_count_;
  std::vector<std::unique_ptr<Decider>> deciders_;  ///< one a thread; the first is the caller's
  std::vector<std::unique_ptr<Decisions>> batches_;
  std::size_t size_ = 0;
  std::atomic<bool> memory_exhausted_ = false;
  std::unique_ptr<Threads> threads_;  ///< made when first needed
};

}  // namespace regulus
