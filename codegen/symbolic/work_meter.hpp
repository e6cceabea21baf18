// SPDX-License-Identifier: GPL-3.0-or-later
// How much work the symbolic stage has done, and when it is to stop.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>

namespace regulus::codegen {

/// Forming took more terms than were allowed.
struct OverBudget {};

/// Forming was stopped from outside: time is up, or the user has interrupted it.
struct FormingStopped {
  bool interrupted = false;  ///< false: time is up
};

/// What may stop the symbolic stage from outside, and who is told how far it is.
struct FormingWatch {
  using Clock = std::chrono::steady_clock;
  Clock::time_point deadline = Clock::time_point::max();
  const std::atomic<bool>* interrupt = nullptr;
  /// Work done and, where there is a limit, the most; called now and then.
  std::function<void(std::uint64_t, std::uint64_t)> progress{};
};

/// Counts terms of polynomials as they are produced: a measure of time and memory that is the same
/// on every machine and in every run, so that what is formed within a budget does not depend on the
/// time it took.
class WorkMeter {
 public:
  static constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

  /// `watch`: null, or it outlives this object.
  explicit WorkMeter(std::uint64_t most, const FormingWatch* watch = nullptr)
      : most_(most), watch_(watch) {}

  /// Asked before the work is done. Throws OverBudget and FormingStopped.
  void spend(std::uint64_t terms) {
    if (terms > most_ - spent_) throw OverBudget{};
    spent_ += terms;
    if (spent_ >= next_look_) look();
  }

  [[nodiscard]] std::uint64_t spent() const noexcept { return spent_; }

 private:
  void look() {
    constexpr std::uint64_t kBetweenLooks = 4096;  // of the order of a millisecond
    next_look_ = spent_ + kBetweenLooks;
    if (watch_ == nullptr) return;
    if (watch_->interrupt != nullptr && *watch_->interrupt) throw FormingStopped{true};
    if (FormingWatch::Clock::now() >= watch_->deadline) throw FormingStopped{false};
    if (watch_->progress) watch_->progress(spent_, most_);
  }

  std::uint64_t most_;
  const FormingWatch* watch_;
  std::uint64_t spent_ = 0, next_look_ = 0;
};

}  // namespace regulus::codegen
