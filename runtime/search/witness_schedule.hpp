// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "runtime/evaluation/decisions.hpp"
#include "runtime/problem/observer.hpp"
#include "runtime/witness/witness_search.hpp"

namespace regulus::detail {

/// Decides when and where a search looks for a witness, so that the effort stays in proportion to
/// that of the boxes.
///
/// Without constraints: at some corners after the first box, which costs no more than a box does; at
/// all corners of the variety and then downhill, if the number of boxes reaches four or four times
/// the number of the last time. With constraints: downhill from boxes inside them, since a segment
/// can be certified only there. A matrix with more rows than columns: for an exact place, seldom.
class WitnessSchedule {
 public:
  /// Both must outlive this object.
  WitnessSchedule(const Problem& problem, WitnessSearch& witness) noexcept
      : problem_(problem), witness_(witness) {}

  /// Returns to the initial state.
  void restart() noexcept { exact_corners_seen_ = false; }

  /// Looks if it is time to; `state` has the number of boxes, and the next time.
  void look_after(const Decisions& batch, SearchState& state) noexcept;

  /// Looks, if it is time to, from an undecided box that is certainly inside the constraints. For
  /// searches of many boxes.
  void look_from(std::span<const Interval> box, SearchState& state) noexcept;

  /// Looks in a box that is given up, the `blocked`-th one.
  void look_in(std::span<const Interval> box, std::uint64_t blocked, SearchState& state) noexcept;

 private:
  [[nodiscard]] bool is_square() const noexcept;
  void look_for_place(std::span<const Interval> box, SearchState& state) noexcept;
  void look_at_all_corners(SearchState& state) noexcept;
  void look_at_exact_ends(std::span<const Interval> box) noexcept;

  const Problem& problem_;
  WitnessSearch& witness_;
  bool exact_corners_seen_ = false;
};

}  // namespace regulus::detail
