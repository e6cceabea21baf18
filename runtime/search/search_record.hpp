// SPDX-License-Identifier: Apache-2.0
// The record of a search: its results so far, its knowledge, and the boxes that are left. The rounds
// use it, which decide the first boxes, and the units, which decide the rest of a long search.
#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <vector>

#include "runtime/evaluation/bisector.hpp"
#include "runtime/problem/observer.hpp"
#include "runtime/search/frontier.hpp"
#include "runtime/search/witness_schedule.hpp"
#include "runtime/witness/witness_search.hpp"

namespace regulus::detail {

class SearchRecord {
 public:
  using Clock = std::chrono::steady_clock;

  /// Both must outlive this object.
  SearchRecord(const Problem& problem, const Settings& settings);

  /// Forgets an earlier search, and takes over the boxes and the state from which the next one
  /// begins. `bisector` and `observer`, which may be null, must outlive the search.
  void begin(std::span<const OpenBox> open, const SearchState& from, const Bisector& bisector,
             Observer* observer);

  /// Puts a box on top of the frontier. Returns false if memory is exhausted.
  [[nodiscard]] bool push_top(const OpenBox& box) noexcept {
    return frontier.push_top(box, bisector_->approx_relative_width(box.box));
  }

  void leave(const OpenBox& box, Rule rule, const Proof& proof) noexcept;
  /// A leaf that was neither certified nor refuted. Looks for a witness in it.
  void block(const OpenBox& box, Reason reason, const Proof& proof) noexcept;
  /// Announces a split. Returns the number of the first half.
  [[nodiscard]] BoxId split(const OpenBox& parent, std::uint32_t variable, double at) noexcept;
  /// Keeps the first witness of an exhaustive search. Moves it.
  void keep_witness(Decision& decision) noexcept;

  /// Stops the search for a reason other than a verdict.
  void stop_at_open_box(Reason reason) noexcept;
  void stop() noexcept { stopped_ = true; }
  /// Stops the search if it was interrupted, is out of boxes or time, or makes no progress.
  [[nodiscard]] bool must_stop(bool has_boxes = true) noexcept;
  /// Replaces the box that a stopped search names.
  void name_open_box(std::span<const Interval> box) noexcept;

  /// Tells the observer about progress, and lets it save the search if it wants to and `may_pause`.
  void tell_progress(bool may_pause = true) noexcept;
  void pause() noexcept;
  /// Tells the observer which boxes are left if the search was stopped.
  void tell_what_is_open() noexcept;

  [[nodiscard]] bool stopped() const noexcept { return stopped_; }
  /// Returns true if the search was stopped by a budget or from outside, not by a verdict.
  [[nodiscard]] bool exhausted() const noexcept { return stopped_by_.has_value(); }
  [[nodiscard]] bool looking_for_witness() const noexcept {
    return !settings.exhaustive && !witness.found();
  }
  [[nodiscard]] Clock::time_point deadline() const noexcept;
  [[nodiscard]] Observer& observer() noexcept { return *observer_; }
  [[nodiscard]] Result conclude();

  const Problem& problem;
  const Settings& settings;
  WitnessSearch witness;
  WitnessSchedule schedule;
  Frontier frontier;
  SearchState state;
  std::uint64_t probes_in_boxes = 0;

 private:
  [[nodiscard]] bool stalls() noexcept;
  void count_up() noexcept;

  Observer silent_;
  Observer* observer_ = &silent_;
  Clock::time_point start_ = Clock::now();
  const Bisector* bisector_ = nullptr;
  std::vector<Interval> top_when_stopped_;
  bool stopped_ = false;
  std::optional<Reason> stopped_by_;
  double seconds_before_ = 0;
};

}  // namespace regulus::detail
