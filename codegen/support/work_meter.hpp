// SPDX-License-Identifier: GPL-3.0-or-later
// Counts the work of the stages before compilation, and stops them at a limit.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>

namespace regulus::detail {

/// Forming took more terms than were allowed.
struct OverBudget {};

/// A stage was stopped from outside: time is up, or the user has interrupted it.
struct FormingStopped {
  bool interrupted = false;  ///< false: time is up
};

/// The stages that check a watch, in their order.
enum class WorkStage {
  kSubstitution,  ///< of the motion into the model, and the scales of the matrix
  kForming,
  kLowering,   ///< of expressions to programs
  kSelection,  ///< of the operations of a kernel, and its text
};

/// Stops the stages before compilation from outside, and receives their progress.
struct FormingWatch {
  using Clock = std::chrono::steady_clock;
  Clock::time_point deadline = Clock::time_point::max();
  const std::atomic<bool>* interrupt = nullptr;
  /// Called from time to time with the work done in a stage and its limit, if there is one.
  std::function<void(WorkStage, std::uint64_t, std::uint64_t)> progress{};
};

/// Counts terms of polynomials, or nodes, as they are produced: a measure of time and memory that
/// is the same on every machine and in every run, so the result of a budget does not depend on the
/// time.
class WorkMeter {
 public:
  static constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

  static constexpr std::uint64_t kBetweenLooks = 4096;  ///< of the order of a millisecond

  /// `watch`: null, or it outlives this object. `first_look`: work that the watch does not stop.
  explicit WorkMeter(std::uint64_t most, const FormingWatch* watch = nullptr,
                     WorkStage stage = WorkStage::kForming, std::uint64_t first_look = 0)
      : most_(most), watch_(watch), stage_(stage), next_look_(first_look) {}

  /// Call it before the work is done. Throws OverBudget and FormingStopped.
  void spend(std::uint64_t terms) {
    if (terms > most_ - spent_) throw OverBudget{};
    spent_ += terms;
    if (spent_ >= next_look_) look();
  }

  [[nodiscard]] std::uint64_t spent() const noexcept { return spent_; }

 private:
  void look() {
    next_look_ = spent_ + kBetweenLooks;
    if (watch_ == nullptr) return;
    if (watch_->interrupt != nullptr && *watch_->interrupt) throw FormingStopped{true};
    if (FormingWatch::Clock::now() >= watch_->deadline) throw FormingStopped{false};
    if (watch_->progress) watch_->progress(stage_, spent_, most_);
  }

  std::uint64_t most_;
  const FormingWatch* watch_;
  WorkStage stage_;
  std::uint64_t spent_ = 0, next_look_;
};

/// Does nothing without a meter.
inline void spend(WorkMeter* meter, std::uint64_t work) {
  if (meter != nullptr) meter->spend(work);
}

}  // namespace regulus::detail
