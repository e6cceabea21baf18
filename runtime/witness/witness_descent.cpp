// SPDX-License-Identifier: Apache-2.0
// Searches for a singularity at the corners, and downhill.
#include <algorithm>
#include <cmath>

#include "runtime/witness/witness_search.hpp"

namespace regulus::detail {
namespace {

/// The corners of a box in six dimensions, in eight groups of eight: within a group any two differ in
/// at least three variables. A group is a coset of the code of the first one.
constexpr unsigned kCode[] = {0b000000, 0b100011, 0b010101, 0b110110,
                              0b001110, 0b101101, 0b011011, 0b111000};
constexpr unsigned kLeader[] = {0, 1, 2, 4, 8, 16, 32, 0b001001};

constexpr int kMaxSweepsOfDescent = 8;
constexpr std::size_t kVariablesAtOnce = kLanes / 2;

}  // namespace

/// Bit k of a corner selects the end of variable k. From the sixth variable on the bits
/// repeat, shifted so that variables six apart do not always agree.
void WitnessSearch::look_at_corners(std::size_t most) noexcept {
  if (!square_ || !uses_corners_) return;
  const std::size_t ends = std::min<std::size_t>(variables_, 6);
  const std::size_t all = std::size_t{1} << ends, corners = std::min(most, all);
  for (std::size_t first = 0; first < corners && !found_; first += kLanes) {
    const std::size_t count = std::min(kLanes, corners - first);
    points_.clear();
    for (std::size_t lane = 0; lane < count; ++lane) {
      for (std::size_t k = 0; k < variables_; ++k) {
        const std::size_t corner =
            all == kMaxCorners ? kCode[lane] ^ kLeader[first / kLanes] : first + lane;
        const bool upper = (corner >> (k % 6) ^ k / 6) & 1U;
        current_[k] = upper ? inner_hi(k) : inner_lo(k);
      }
      load_point(lane, current_.data());
    }
    evaluate_points(count);
    look_at_points(points_.loaded());
  }
}

/// Returns where a single move of a variable ends. A coordinate of a ball does not move alone, or
/// only within the cube in the ball if the box cuts the ball.
double WitnessSearch::target(std::size_t variable, double end, Interval range) const noexcept {
  if (!in_ball_[variable]) return end;
  if (certain_subset(*reach_[variable], range)) return current_[variable];
  const Interval& cube = *problem_.inner[variable];
  return std::clamp(end, cube.lo, cube.hi);
}

/// Tries both ends of up to four variables and keeps the best single move. `best` is sign·det at
/// current_, falling.
bool WitnessSearch::step(std::span<const Interval> box, std::size_t first, double sign,
                         double& best) noexcept {
  const std::size_t last = std::min(first + kVariablesAtOnce, variables_);
  bool can_move = false;
  for (std::size_t k = first; k < last; ++k)
    can_move = can_move || target(k, box[k].lo, box[k]) < target(k, box[k].hi, box[k]);
  if (!can_move) return false;
  points_.clear();
  load_point(0, current_.data());
  points_.spread(2 * (last - first));
  std::size_t count = 0;
  for (std::size_t k = first; k < last; ++k)
    for (const double end : {box[k].lo, box[k].hi})
      points_.change(count++, k, within_inner(k, target(k, end, box[k])));
  evaluate_points(count);
  std::size_t chosen = kLanes;
  const LaneMask usable = points_.preconditioned() & points_.midpoint_inside();
  for_each_lane(usable, [&](std::size_t lane) {
    const double value = sign * approx_objective(lane);
    if (value < best) best = value, chosen = lane;
  });
  if (chosen != kLanes) {
    const std::size_t k = first + chosen / 2;
    current_[k] = points_.midpoint(k, chosen);
  }
  look_at_points(points_.loaded());
  return chosen != kLanes;
}

/// Moves one point of the robot within its ball, against the gradient, which is the same all over
/// the ball if the determinant is linear in the point.
bool WitnessSearch::step_ball(std::span<const Interval> box, const ToleranceBalls::Ball& ball,
                              double sign, double& best) noexcept {
  const std::size_t n = ball.members.size();
  if (2 * n > kLanes) return false;
  // A ball that the box cuts does not move.
  for (const std::size_t k : ball.members)
    if (!certain_subset(*reach_[k], box[k])) return false;
  points_.clear();
  load_point(0, current_.data());
  points_.spread(2 * n);
  const double distance = 0.5 * ball.radius;
  for (std::size_t lane = 0; lane < 2 * n; ++lane)
    for (std::size_t i = 0; i < n; ++i) {
      const double offset = i != lane / 2 ? 0.0 : lane % 2 == 0 ? -distance : distance;
      points_.change(lane, ball.members[i], Interval(mid(ball.center[i]) + offset));
    }
  evaluate_points(2 * n);
  if ((points_.preconditioned() & points_.midpoint_inside() & points_.loaded()) != points_.loaded())
    return false;
  double slope[kLanes], length = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    slope[i] = sign * (approx_objective(2 * i + 1) - approx_objective(2 * i));
    length = std::hypot(length, slope[i]);
  }
  if (!(length > 0.0)) return false;
  std::copy(current_.begin(), current_.end(), downhill_.begin());
  for (std::size_t i = 0; i < n; ++i)
    downhill_[ball.members[i]] = mid(ball.center[i]) - ball.radius * slope[i] / length;
  balls_.pull_in(downhill_);
  points_.clear();
  load_point(0, downhill_.data());
  evaluate_points(1);
  if ((points_.preconditioned() & points_.midpoint_inside() & 1U) == 0) return false;
  const double value = sign * approx_objective(0);
  const bool better = value < best;
  if (better) best = value, current_.swap(downhill_);
  look_at_points(1U);
  return better;
}

/// Adds a point of points_ to the starts if the determinant is approximately known there.
void WitnessSearch::add_start(std::size_t lane, double sign) noexcept {
  if (!has_lane(points_.preconditioned() & points_.midpoint_inside(), lane)) return;
  Start& start = starts_[start_count_++];
  start.value = sign * approx_objective(lane);
  for (std::size_t k = 0; k < variables_; ++k) start.point[k] = points_.midpoint(k, lane);
}

/// Starts from the middle, and from ends of the ranges of the uncertain quantities: if two of them
/// must move together, no single move is downhill. The lowest comes first.
void WitnessSearch::find_starts(std::span<const Interval> box, double sign) noexcept {
  const std::size_t first = problem_.kernel->motion_variables;
  start_count_ = 0;
  add_start(0, sign);
  if (first == variables_) return;
  points_.clear();
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    for (std::size_t k = first; k < variables_; ++k) {
      const bool upper = (lane >> ((k - first) % 3) ^ (k - first) / 3) & 1U;
      current_[k] = std::clamp(upper ? box[k].hi : box[k].lo, inner_lo(k), inner_hi(k));
    }
    load_point(lane, current_.data());
  }
  evaluate_points(kLanes);
  look_at_points(points_.loaded());
  for (std::size_t lane = 0; lane < kLanes; ++lane) add_start(lane, sign);
  std::sort(starts_.begin(), starts_.begin() + static_cast<std::ptrdiff_t>(start_count_),
            [](const Start& a, const Start& b) { return a.value < b.value; });
}

void WitnessSearch::descend(std::span<const Interval> box, std::size_t most_starts) noexcept {
  if (!square_ || !uses_descents_ || found_) return;
  for (std::size_t k = 0; k < variables_; ++k)
    current_[k] = std::clamp(mid(box[k]), inner_lo(k), inner_hi(k));
  points_.clear();
  load_point(0, current_.data());
  evaluate_points(1);
  // A segment can only be certified inside constraints, so the pair must come from this box.
  if (problem_.kernel->constraints > 0) positive_.approx = negative_.approx = 0.0;
  if (problem_.kernel->constraints > 0) positive_.tried = negative_.tried = 0.0;
  const bool known = (points_.preconditioned() & points_.midpoint_inside() & 1U) != 0;
  const double sign = known && approx_objective(0) < 0.0 ? -1.0 : 1.0;
  look_at_points(1U);
  if (!known) return;
  find_starts(box, sign);
  for (std::size_t s = 0; s < std::min(start_count_, most_starts) && !found_; ++s) {
    std::copy(starts_[s].point.begin(), starts_[s].point.end(), current_.begin());
    go_downhill(box, sign, starts_[s].value);
  }
}

/// Moves from current_, where sign·det is `best`.
void WitnessSearch::go_downhill(std::span<const Interval> box, double sign, double best) noexcept {
  for (int sweep = 0; sweep < kMaxSweepsOfDescent && best > 0.0 && !found_; ++sweep) {
    bool moved = false;
    for (std::size_t k = 0; k < variables_ && !found_; k += kVariablesAtOnce)
      if (step(box, k, sign, best)) moved = true;
    for (const ToleranceBalls::Ball& ball : balls_.balls())
      if (!found_ && step_ball(box, ball, sign, best)) moved = true;
    if (!moved) return;
  }
}

}  // namespace regulus::detail
