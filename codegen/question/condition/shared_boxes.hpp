// SPDX-License-Identifier: GPL-3.0-or-later
// Gives boxes of the search of a condition number to workers.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "codegen/question/condition/condition_units.hpp"
#include "runtime/cluster/supervisor.hpp"

namespace regulus {

/// The workers of a search, and when they are of use.
struct BoxSharing {
  cluster::Workers* workers = nullptr;  ///< null: there are none
  std::uint64_t boxes_before = 16384;   ///< workers need some time before their first box
  double time_limit = std::numeric_limits<double>::infinity();  ///< seconds, to wait for them
  const std::atomic<bool>* interrupt = nullptr;
};

/// The workers begin with the first boxes that are given to them and end with this object.
class SharedBoxes {
 public:
  /// The parts of the question must outlive this object.
  SharedBoxes(const ConditionQuestion& question, const BoxSharing& sharing)
      : question_(question), sharing_(sharing) {}
  ~SharedBoxes() { end(); }
  SharedBoxes(const SharedBoxes&) = delete;
  SharedBoxes& operator=(const SharedBoxes&) = delete;

  /// Decides boxes as BoxJudge does. Returns false if workers are of no use for them, or if the user
  /// interrupts; some of the findings may then be known.
  ///
  /// Throws    std::bad_alloc; the exceptions of the workers and of Supervisor.
  [[nodiscard]] bool judge(std::span<const BoxJudge::Box> boxes, std::span<BoxFinding> findings,
                           double attained);

 private:
  using Clock = std::chrono::steady_clock;

  void begin();
  void end() noexcept;
  void exchange_messages();
  [[nodiscard]] bool take_first(std::span<BoxFinding>& findings);
  void show_now_and_then();
  [[nodiscard]] bool is_interrupted() const {
    return sharing_.interrupt != nullptr && *sharing_.interrupt;
  }

  const ConditionQuestion question_;
  const BoxSharing sharing_;
  std::uint64_t boxes_ = 0;  ///< seen so far
  bool is_over_ = false;
  std::optional<cluster::Supervisor> supervisor_;  ///< one for all boxes: answers may come late
  Settings settings_;
  const cluster::Learned learned_{};
  double shown_at_ = 0;
  const Clock::time_point start_ = Clock::now();
};

}  // namespace regulus
