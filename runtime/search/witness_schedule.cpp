// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/witness_schedule.hpp"

#include <algorithm>

namespace regulus::detail {
namespace {

/// The number of witness searches that start from boxes that could not be decided. The first of
/// them starts from so many places of the uncertain quantities.
constexpr std::uint64_t kMaxDescentsFromBlocked = 16;
constexpr std::size_t kStartsFromBlocked = 9;

/// The number of boxes at which to go downhill for the first time, if there are more than a few
/// variables: the cost grows with their number.
constexpr std::uint64_t kFirstDescent = 4;
constexpr unsigned kFewVariables = 4;

/// A matrix with more rows than columns has no determinant whose sign changes. The number of boxes
/// at which to look for a singular place by algebra for the first time, and the factor from one time to the next.
constexpr std::uint64_t kFirstPlace = 8192, kNextPlace = 16;

}  // namespace

void WitnessSchedule::look_after(const Decisions& batch, SearchState& state) noexcept {
  LaneMask undecided = batch.uncertified;
  const std::uint64_t boxes = state.statistics.boxes;
  if (undecided == 0 || boxes < state.next_descent) return;
  std::size_t lane = 0;
  while (!has_lane(undecided, lane)) ++lane;
  if (!is_square()) return look_for_place(batch.open(lane).box, state);
  if (problem_.kernel->constraints > 0) {
    undecided &= batch.inside;
    if (undecided == 0) return;
    while (!has_lane(undecided, lane)) ++lane;
    state.next_descent = boxes + 1 + boxes / 8;
  } else if (boxes < kFirstDescent && problem_.kernel->variables > kFewVariables) {
    state.next_descent = kFirstDescent;
    return witness_.look_at_some_corners();
  } else {
    look_at_all_corners(state);
  }
  witness_.descend(batch.open(lane).box);
  look_at_exact_ends(batch.open(lane).box);
}

void WitnessSchedule::look_from(std::span<const Interval> box, SearchState& state) noexcept {
  const std::uint64_t boxes = state.statistics.boxes;
  if (boxes < state.next_descent) return;
  if (!is_square()) return look_for_place(box, state);
  if (problem_.kernel->constraints > 0)
    state.next_descent = boxes + 1 + boxes / 8;
  else
    look_at_all_corners(state);
  witness_.descend(box);
  look_at_exact_ends(box);
}

void WitnessSchedule::look_in(std::span<const Interval> box, std::uint64_t blocked,
                              SearchState& state) noexcept {
  if (blocked > kMaxDescentsFromBlocked || !is_square()) return;
  if (problem_.kernel->constraints == 0 && state.next_descent <= kFirstDescent)
    look_at_all_corners(state);
  witness_.descend(box, blocked == 1 ? kStartsFromBlocked : 1);
  look_at_exact_ends(box);
}

bool WitnessSchedule::is_square() const noexcept {
  return problem_.kernel->rows == problem_.kernel->columns;
}

/// Also sets the next time. The conclusion of the search looks once more, near a box that blocks.
void WitnessSchedule::look_for_place(std::span<const Interval> box, SearchState& state) noexcept {
  const std::uint64_t boxes = state.statistics.boxes;
  state.next_descent = std::max(kNextPlace * boxes, kFirstPlace);
  if (boxes < kFirstPlace) return;
  witness_.look_for_exact_place(box);
  witness_.look_for_null_vector(box);
}

/// Looks at them once, and sets the next time to go downhill.
void WitnessSchedule::look_at_all_corners(SearchState& state) noexcept {
  if (state.next_descent <= kFirstDescent) witness_.look_at_corners();
  state.next_descent = std::max(4 * state.statistics.boxes, kFirstDescent + 1);
}

/// Looks for a determinant that is 0 at an end that is not a double. Bounds in doubles cannot show
/// this.
void WitnessSchedule::look_at_exact_ends(std::span<const Interval> box) noexcept {
  if (!exact_corners_seen_) witness_.look_at_exact_corners();
  exact_corners_seen_ = true;
  witness_.look_at_ends(box);
}

}  // namespace regulus::detail
