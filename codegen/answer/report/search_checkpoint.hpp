// SPDX-License-Identifier: GPL-3.0-or-later
// The option --checkpoint of one search, or of several one after the other, whose boxes are judged
// again when it continues.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "codegen/answer/report/json_checkpoint.hpp"
#include "codegen/question/engine/options.hpp"

namespace regulus {

/// When a search is saved: so often that little is lost, so seldom that it costs little.
class SavePace {
 public:
  /// `interval`: seconds between two saves, at most, unless saving takes long.
  explicit SavePace(double interval) : interval_(interval) {}

  [[nodiscard]] bool is_due() const {
    return Seconds(Clock::now() - saved_) >= std::max(interval_, kPartForSaving * cost_);
  }
  /// Calls save(), and measures it.
  template <class Save>
  void pass(const Save& save) {
    const Clock::time_point start = Clock::now();
    save();
    saved_ = Clock::now();
    cost_ = saved_ - start;
  }

 private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  static constexpr double kPartForSaving = 20;

  const Seconds interval_;
  Clock::time_point saved_ = Clock::now();
  Seconds cost_{0};
};

class SearchCheckpoint {
 public:
  /// An empty path means no file. `question()`: everything that the boxes depend on. Throws as
  /// JsonCheckpoint.
  SearchCheckpoint(const CheckpointOptions& options,
                   const std::function<nlohmann::ordered_json()>& question);

  /// Returns nullptr if there is none.
  [[nodiscard]] JsonCheckpoint* file() const noexcept { return file_.get(); }
  /// Returns the seconds between two saves, at most.
  [[nodiscard]] double interval() const noexcept { return interval_; }

  /// Call it after the search: the file stays if that can continue.
  void finish(bool can_continue);
  /// Returns the lines of the report.
  [[nodiscard]] std::string line() const;

 private:
  double interval_;
  std::unique_ptr<JsonCheckpoint> file_;
  bool was_there_ = false, is_kept_ = false;
};

}  // namespace regulus
