// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <limits>

namespace regulus::detail {

/// The time of a task, and of all the work that the task belongs to. A search ends with its task.
/// Forming a matrix may take all of the time, because without it nothing is known.
class TimeBudget {
 public:
  /// `task`, `all`: seconds from now on. All of the work has at least the time of the task.
  explicit TimeBudget(double task, double all = 0) : task_(task), all_(std::max(task, all)) {}
  /// Returns the budget of an option, where 0 is no limit.
  [[nodiscard]] static TimeBudget of_option(double limit, double all = 0) {
    return TimeBudget(limit == 0 ? std::numeric_limits<double>::infinity() : limit, all);
  }

  /// Returns the seconds that are left of the task, and of all the work.
  [[nodiscard]] double left() const { return std::max(0.0, task_ - elapsed()); }
  [[nodiscard]] double all() const { return std::max(0.0, all_ - elapsed()); }
  [[nodiscard]] bool is_over() const { return left() <= 0; }
  /// Returns the budget of the first of `n` tasks with equal shares.
  [[nodiscard]] TimeBudget share(std::size_t n) const {
    return TimeBudget(left() / double(n), all());
  }
  /// Gives the task enough for a search that attains an end, if all the work has as much.
  void grant_least() { task_ = std::max(task_, elapsed() + std::min(kLeastSearch, all())); }

  /// Returns seconds as an option of a search.
  [[nodiscard]] static double option(double seconds) { return std::max(seconds, kShortest); }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] double elapsed() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }

  static constexpr double kLeastSearch = 0.5;
  static constexpr double kShortest = 1e-3;  ///< 0 is no limit

  Clock::time_point start_ = Clock::now();
  double task_, all_;  ///< seconds since then
};

}  // namespace regulus::detail
