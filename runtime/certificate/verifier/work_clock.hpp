// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "runtime/certificate/verifier/expression.hpp"
#include "runtime/certificate/verifier/verify.hpp"

namespace regulus::verifier {

/// Checks the time limit and reports progress.
class WorkClock {
 public:
  WorkClock(const Options& options, const Verification& counts)
      : options_(options), counts_(counts), start_(Clock::now()), reported_(start_) {}

  /// Call it before each piece of work. Throws Unfinished if the time is over.
  void tick() {
    if (options_.time_limit <= 0 && !options_.progress) return;
    const auto now = Clock::now();
    if (options_.time_limit > 0 && Seconds(now - start_).count() > options_.time_limit)
      throw Unfinished("the time limit was reached");
    if (!options_.progress || Seconds(now - reported_).count() < kBetweenReports) return;
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
};

}  // namespace regulus::verifier
