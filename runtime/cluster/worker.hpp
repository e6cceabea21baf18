// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/cluster/messages.hpp"

namespace regulus::detail::cluster {

/// Decides the units that it is granted, one at a time. It knows neither threads nor processes: a
/// transport brings the messages and the time.
class Worker {
 public:
  /// A worker without work says so at these intervals, in seconds: the grant may have been lost.
  static constexpr double kReminder = 1.0;

  /// Throws MalformedMessage.
  void receive(std::string_view grant) { grants_.push_back(begin(read_grant(grant))); }
  [[nodiscard]] bool has_work() const noexcept { return !grants_.empty(); }

  /// Decides one unit. Returns an answer if it was the last of a grant. `now` returns seconds.
  ///
  /// Requires  has_work().
  template <typename Now>
  [[nodiscard]] std::optional<std::string> step(UnitDecider& decider, const Now& now) {
    const double before = now();
    const bool decided = decide_next(decider);
    if (!decided) return std::nullopt;
    return end_step(now() - before);
  }

  /// Returns a message if there has been nothing to do for some time.
  [[nodiscard]] std::optional<std::string> tick(double now);

 private:
  struct Progress {
    Grant grant;
    std::vector<std::size_t> left;  ///< numbers of units; the next one is the last
    std::uint64_t boxes = 0;
    Answer answer;
  };

  [[nodiscard]] static Progress begin(Grant grant);
  [[nodiscard]] bool decide_next(UnitDecider& decider);
  [[nodiscard]] std::optional<std::string> end_step(double seconds);

  std::deque<Progress> grants_;
  double reminded_ = 0;
};

}  // namespace regulus::detail::cluster
