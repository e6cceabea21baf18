// SPDX-License-Identifier: Apache-2.0
// Batches of boxes that are decided together, by one or several threads.
//
// The search chooses the number of batches, independently of the threads. Each batch is decided by
// itself. One thread draws the conclusions afterwards, batch by batch. So the results of a search
// are the same for any number of threads.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <vector>

#include "runtime/search/decider.hpp"
#include "runtime/search/foresight.hpp"

namespace regulus::detail {

class Round {
 public:
  using Clock = std::chrono::steady_clock;

  /// All three must outlive this object.
  Round(const Problem& problem, const Settings& settings, const RowStructure& structure);
  ~Round();

  /// Becomes that of the problem whose ranges have changed.
  void take_ranges();

  /// After `deadline`, or after an interrupt, batches after the first are not decided.
  void begin(Clock::time_point deadline) noexcept { deadline_ = deadline; }
  void clear() noexcept { size_ = 0; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Adds a batch without boxes; returns null if memory is exhausted.
  [[nodiscard]] Decisions* append() noexcept;
  [[nodiscard]] Decisions& batch(std::size_t index) noexcept { return *batches_[index]; }

  /// Decides every batch that has boxes.
  ///
  /// Ensures   false: memory was exhausted, and some batches are undecided.
  [[nodiscard]] bool decide(const AdaptiveThreshold& threshold) noexcept;

  /// Decides a batch that is alone, if it was foreseen; false: it is undecided.
  [[nodiscard]] bool decide(Foresight& foresight) noexcept;

  /// Returns the order of the vectors that prove regularity.
  [[nodiscard]] std::size_t order() const noexcept { return deciders_.front()->order(); }
  [[nodiscard]] const Bisector& bisector() const noexcept { return deciders_.front()->bisector(); }

 private:
  class Threads;
  void decide(Decider& decider, std::size_t index) noexcept;
  void decide_in_parallel();
  [[nodiscard]] bool must_stop() const noexcept;

  const Problem& problem_;
  const Settings& settings_;
  const RowStructure& structure_;
  Clock::time_point deadline_ = Clock::time_point::max();
  const unsigned thread_count_;
  std::vector<std::unique_ptr<Decider>> deciders_;  ///< one per thread; the first is the caller's
  std::vector<std::unique_ptr<Decisions>> batches_;
  std::size_t size_ = 0;
  std::atomic<bool> memory_exhausted_ = false;
  std::unique_ptr<Threads> threads_;  ///< made when first needed
};

}  // namespace regulus::detail
