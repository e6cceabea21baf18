// SPDX-License-Identifier: Apache-2.0
// Gives boxes of a search to workers.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/cluster/supervisor.hpp"
#include "runtime/cluster/workers.hpp"

namespace regulus::detail {

/// The workers of a search, and when they are of use.
struct BoxSharing {
  cluster::Workers* workers = nullptr;  ///< null: there are none
  std::uint64_t boxes_before = 16384;   ///< workers need some time before their first box
  double time_limit = std::numeric_limits<double>::infinity();  ///< seconds, to wait for them
  const std::atomic<bool>* interrupt = nullptr;
};

/// Returns boxes as a unit. Its outcome depends on the boxes and on the horizon alone.
///
/// Requires  1 to kLanes boxes; horizon ≥ 0.
[[nodiscard]] cluster::Unit unit_of(std::span<const std::vector<Interval>> boxes, double horizon);
/// Returns the boxes of a unit. Throws MalformedMessage.
[[nodiscard]] std::vector<std::vector<Interval>> boxes_of(const cluster::Unit& unit,
                                                          std::size_t intervals);

/// The workers begin with the first boxes that are given to them and end with this object.
class SharedBoxes {
 public:
  using Box = std::vector<Interval>;
  /// Reads the findings about `count` boxes, from the one with the number `at` on.
  using Take = std::function<void(std::size_t at, std::size_t count, std::string_view findings)>;

  /// `make`: makes judges of such units. `settings`: of the judges, for other processes. The problem
  /// must outlive this object.
  SharedBoxes(const Problem& problem, const Settings& settings, cluster::MakeDecider make,
              const BoxSharing& sharing)
      : problem_(problem), make_(std::move(make)), sharing_(sharing), settings_(settings) {}
  ~SharedBoxes() { end(); }
  SharedBoxes(const SharedBoxes&) = delete;
  SharedBoxes& operator=(const SharedBoxes&) = delete;

  /// Has boxes judged. Returns false if workers are of no use for them, or if the user interrupts;
  /// some of the findings may then have been taken.
  ///
  /// Throws    std::bad_alloc; the exceptions of the workers, of Supervisor and of `take`.
  [[nodiscard]] bool judge(std::span<const Box> boxes, double horizon, const Take& take);

 private:
  using Clock = std::chrono::steady_clock;

  void begin();
  void end() noexcept;
  void exchange_messages();
  [[nodiscard]] bool take_first(std::size_t& at, const Take& take);
  void show_now_and_then();
  [[nodiscard]] bool is_interrupted() const {
    return sharing_.interrupt != nullptr && *sharing_.interrupt;
  }

  const Problem& problem_;
  const cluster::MakeDecider make_;
  const BoxSharing sharing_;
  std::uint64_t boxes_ = 0;  ///< seen so far
  bool is_over_ = false;
  std::optional<cluster::Supervisor> supervisor_;  ///< one for all boxes: answers may come late
  Settings settings_;
  const cluster::Learned learned_{};
  double shown_at_ = 0;
  const Clock::time_point start_ = Clock::now();
};

}  // namespace regulus::detail
