// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

namespace regulus::detail {

/// Measures the time since its construction or the last lap.
class Stopwatch {
 public:
  [[nodiscard]] double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace regulus::detail
