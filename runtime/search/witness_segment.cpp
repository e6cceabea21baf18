// SPDX-License-Identifier: Apache-2.0
// The segment between two points of opposite signs, and closing in on it.
#include <algorithm>
#include <array>
#include <cmath>

#include "regulus/search/witness_search.hpp"

namespace regulus {
namespace {

/// Pieces of the segment that are looked at before giving up; the narrowest is 2^-kMaxHalvings.
constexpr std::size_t kMaxPieces = 4096;
constexpr std::size_t kMaxHalvings = 30;

/// Steps of closing in: after 60 halvings a segment is at the resolution of doubles.
constexpr int kMaxCloseIn = 60;

}  // namespace

/// Encloses from + (to − from)·part. Both ends lie in the inner box, which is convex, so the exact
/// segment does; that the rounding may lead a little out of it only makes the check stricter.
void WitnessSearch::load_piece(std::size_t lane, const std::vector<double>& from,
                               const std::vector<double>& to, Interval part) noexcept {
  for (std::size_t k = 0; k < variables_; ++k) {
    const Interval a = within_inner(k, from[k]);
    const Interval b = within_inner(k, to[k]);
    box_[k] = a == b ? a : a + (b - a) * part;
  }
  points_.load(lane, box_);
}

bool WitnessSearch::certain_segment(const std::vector<double>& from,
                                    const std::vector<double>& to) noexcept {
  // Depth first: at most one waiting half for each halving.
  std::array<Interval, kMaxHalvings + 1> waiting;
  std::size_t count = 0;
  waiting[count++] = Interval(0.0, 1.0);
  for (std::size_t pieces = 0; count > 0; ++pieces) {
    if (pieces == kMaxPieces) return false;
    const Interval part = waiting[--count];
    points_.clear();
    load_piece(0, from, to, part);
    points_.seal(1);
    LaneMask certain = points_.certain_inside() & points_.certain_posed() & 1U;
    static_cast<void>(points_.product({}, certain));
    if (certain != 0) continue;
    const double middle = 0.5 * (part.lo + part.hi);  // exact: a multiple of 2^-kMaxHalvings
    if (count + 2 > waiting.size() || part.hi - part.lo < 0x1p-29) return false;
    waiting[count++] = Interval(middle, part.hi);
    waiting[count++] = Interval(part.lo, middle);
  }
  return true;
}

/// Shortens the segment while the sign of its middle can be told. Each shorter pair is a proof of
/// its own: its signs are certified, and so is its segment.
void WitnessSearch::close_in() noexcept {
  const Candidate far_positive = positive_;
  const Candidate far_negative = negative_;
  for (int step = 0; step < kMaxCloseIn; ++step) {
    bool moved = false;
    for (std::size_t k = 0; k < variables_; ++k) {
      middle_[k] =
          std::clamp(0.5 * positive_.point[k] + 0.5 * negative_.point[k], inner_lo(k), inner_hi(k));
      moved = moved || (middle_[k] != positive_.point[k] && middle_[k] != negative_.point[k]);
    }
    if (!moved) break;
    const std::optional<Interval> determinant = certify_point(middle_, false);
    if (!determinant || certain_sign(*determinant) == 0) break;
    Candidate& side = certain_sign(*determinant) > 0 ? positive_ : negative_;
    side.point = middle_;
    side.determinant = *determinant;
  }
  if (certain_segment(positive_.point, negative_.point)) return;
  positive_ = far_positive;
  negative_ = far_negative;
}

void WitnessSearch::copy_pose(const std::vector<Interval>& point,
                              std::vector<Interval>& pose) noexcept {
  pose.clear();
  if (problem_.kernel->pose == nullptr) return;
  points_.clear();
  points_.load(0, point);
  points_.seal(1);
  if (!has_lane(points_.call_on_boxes(problem_.kernel->pose, pose_.get()), 0)) return;
  for (std::size_t k = 0; k < problem_.kernel->pose_parameters; ++k)
    pose.push_back({pose_[lower_at(k, 0)], pose_[upper_at(k, 0)]});
}

void WitnessSearch::report(WitnessPoint& into, const Candidate& candidate) noexcept {
  into.variables.clear();
  for (std::size_t k = 0; k < variables_; ++k)
    into.variables.push_back(within_inner(k, candidate.point[k]));
  into.determinant = candidate.determinant;
  copy_pose(into.variables, into.pose);
}

/// Fills the same vectors each time: they grow once.
const Witness& WitnessSearch::witness() noexcept {
  witness_.near.clear();
  witness_.near_pose.clear();
  if (reason_ == Reason::kSmallDeterminant) {
    witness_.points.resize(1);
    report(witness_.points[0], small_);
    return witness_;
  }
  witness_.points.resize(2);
  report(witness_.points[0], positive_);
  report(witness_.points[1], negative_);
  for (std::size_t k = 0; k < variables_; ++k)
    witness_.near.push_back(within_inner(k, 0.5 * positive_.point[k] + 0.5 * negative_.point[k]));
  copy_pose(witness_.near, witness_.near_pose);
  return witness_;
}

}  // namespace regulus
