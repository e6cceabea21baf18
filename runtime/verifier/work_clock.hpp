// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>

#include "runtime/verifier/expression.hpp"
#include "runtime/verifier/verify.hpp"

namespace regulus::verifier {

/// Checks the time limit and reports progress.
class WorkClock {
 public:
  WorkClock(const Options& options, const Verification& counts)
      : options_(options), counts_(counts), start_(Clock::now()), reported_(start_) {}

  /// For another thread: it began when `other` did, and reports nothing.
  WorkClock(const WorkClock& other, const std::atomic<bool>& stop)
      : options_(other.options_), counts_(other.counts_), start_(other.start_), stop_(&stop) {}

  /// Call it before each piece of work. Throws Unfinished if the time is over, or `stop` is set.
  void tick() {
    if (stop_ != nullptr && stop_->load(std::memory_order_relaxed)) throw Unfinished("stopped");
    if (options_.time_limit <= 0 && !options_.progress) return;
    const auto now = Clock::now();
    if (options_.time_limit > 0 && Seconds(now - start_).count() > options_.time_limit)
      throw Unfinished("the time limit was reached");
    if (stop_ != nullptr || !options_.progress ||
        Seconds(now - reported_).count() < kBetweenReports)
      return;
    reported_ = now;
    options_.progress(counts_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  static constexpr double kBetweenReports = 0.2;

  const Options& options_;
  const Verification& counts_;
  const Clock::time_point start_;
  Clock::time_point reported_;
  const std::atomic<bool>* stop_ = nullptr;  ///< for a thread beside the first
};

}  // namespace regulus::verifier
