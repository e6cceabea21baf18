// SPDX-License-Identifier: Apache-2.0
// Searches for a singularity at the corners, and downhill.
#include <algorithm>
#include <cmath>

#include "runtime/witness/witness_search.hpp"

namespace regulus {
namespace {

constexpr std::size_t kMaxCorners = 64;
constexpr int kMaxSweeps = 8;
constexpr std::size_t kVariablesAtOnce = kLanes / 2;

}  // namespace

/// Corner number c: bit k of c selects the end of variable k. From the sixth variable on the bits
/// repeat, shifted so that variables six apart do not always agree.
void WitnessSearch::look_at_corners() noexcept {
  if (!square_ || !uses_corners_) return;
  const std::size_t ends = std::min<std::size_t>(variables_, 6);
  const std::size_t corners = std::min(kMaxCorners, std::size_t{1} << ends);
  for (std::size_t first = 0; first < corners && !found_; first += kLanes) {
    const std::size_t count = std::min(kLanes, corners - first);
    points_.clear();
    for (std::size_t lane = 0; lane < count; ++lane) {
      for (std::size_t k = 0; k < variables_; ++k) {
        const bool upper = ((first + lane) >> (k % 6) ^ k / 6) & 1U;
        current_[k] = upper ? inner_hi(k) : inner_lo(k);
      }
      load_point(lane, current_.data());
    }
    evaluate_points(count);
    look_at_points(points_.loaded());
  }
}

/// Tries both ends of up to four variables and keeps the best single move. `best` is sign·det at
/// current_, falling.
bool WitnessSearch::step(std::span<const Interval> box, std::size_t first, double sign,
                         double& best) noexcept {
  const std::size_t last = std::min(first + kVariablesAtOnce, variables_);
  points_.clear();
  load_point(0, current_.data());
  points_.spread(2 * (last - first));
  std::size_t count = 0;
  for (std::size_t k = first; k < last; ++k)
    for (const double end : {box[k].lo, box[k].hi})
      points_.change(count++, k, within_inner(k, std::clamp(end, inner_lo(k), inner_hi(k))));
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

void WitnessSearch::descend(std::span<const Interval> box) noexcept {
  if (!square_ || !uses_descents_ || found_) return;
  for (std::size_t k = 0; k < variables_; ++k)
    current_[k] = std::clamp(mid(box[k]), inner_lo(k), inner_hi(k));
  points_.clear();
  load_point(0, current_.data());
  evaluate_points(1);
  if ((points_.preconditioned() & points_.midpoint_inside()) == 0) return;
  const double start = approx_objective(0);
  const double sign = start < 0.0 ? -1.0 : 1.0;
  double best = std::fabs(start);
  // A segment can only be certified inside constraints, so the pair must come from this box.
  if (problem_.kernel->constraints > 0) positive_.approx = negative_.approx = 0.0;
  if (problem_.kernel->constraints > 0) positive_.tried = negative_.tried = 0.0;
  look_at_points(1U);
  for (int sweep = 0; sweep < kMaxSweeps && best > 0.0 && !found_; ++sweep) {
    bool moved = false;
    for (std::size_t k = 0; k < variables_ && !found_; k += kVariablesAtOnce)
      if (step(box, k, sign, best)) moved = true;
    if (!moved) return;
  }
}

}  // namespace regulus
