// SPDX-License-Identifier: GPL-3.0-or-later
// Shows the progress of a run to the person at a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <ostream>
#include <string>

#include "tests/attack/runner/summary.hpp"

namespace regulus::detail::attack {

/// Returns, for example, "120 of 1000 models, 14.2 a second, 0 contradictions".
[[nodiscard]] std::string progress_text(const Summary& summary, std::uint64_t total,
                                        double seconds);

/// A line that is overwritten again and again, and removed at the end.
class Progress {
 public:
  /// Writes nothing unless `shown`.
  Progress(std::ostream& out, bool shown, std::uint64_t total)
      : out_(out), shown_(shown), total_(total) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// Call this after each model; most calls write nothing.
  void update(const Summary& summary);

 private:
  using Clock = std::chrono::steady_clock;

  std::ostream& out_;
  const bool shown_;
  const std::uint64_t total_;
  const Clock::time_point begin_ = Clock::now();
  Clock::time_point next_ = begin_;
};

}  // namespace regulus::detail::attack
