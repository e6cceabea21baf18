// SPDX-License-Identifier: Apache-2.0
// The segment between two points of opposite signs, and its refinement.
#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/regularity/determinant.hpp"
#include "runtime/witness/approx_zero.hpp"
#include "runtime/witness/witness_search.hpp"

namespace regulus::detail {
namespace {

/// The number of tested pieces before giving up; the narrowest piece is 2^-kMaxHalvings.
constexpr std::size_t kMaxPieces = 4096;
constexpr std::size_t kMaxHalvings = 30;

/// After so many halvings a segment is at the resolution of doubles. Three of them follow one look at
/// several points.
constexpr std::size_t kMaxCloseIn = 60, kHalvingsALook = 3;

/// Plain doubles tell the signs until the determinants at the ends of the segment are about as large
/// as so many widths of their enclosures; in so many looks.
constexpr double kSafeWidths = 16.0;
constexpr std::size_t kMaxLeap = 48;
constexpr unsigned kMaxLooks = 6;

/// The first step away from a point whose sign is not known, as a part of the way to the next point
/// with a known sign, and the growth of the steps.
constexpr double kNearest = 0x1p-48, kGrowth = 16.0;

/// Returns for how many halvings the signs of determinants in plain doubles are safe to use.
std::size_t safe_halvings(const Interval& positive, const Interval& negative) noexcept {
  const double width = std::max(positive.hi - positive.lo, negative.hi - negative.lo);
  const double widths = (mid(positive) - mid(negative)) / (kSafeWidths * width);
  if (!(widths >= 1.0)) return 0;
  return std::min(kMaxLeap, static_cast<std::size_t>(std::ilogb(std::min(widths, 0x1p60))));
}

}  // namespace

/// Encloses from + (to − from)·part. Both ends lie in the ranges and balls, which are convex, so the
/// exact segment does. Rounding may extend slightly beyond it, which only makes the check stricter.
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

/// Computes the point that is that part of the way from `a` to `b`; returns false if it is one of
/// them.
bool WitnessSearch::find_between(const std::vector<double>& a, const std::vector<double>& b,
                                 double part, std::vector<double>& into) noexcept {
  for (std::size_t k = 0; k < variables_; ++k)
    into[k] = std::clamp((1.0 - part) * a[k] + part * b[k], inner_lo(k), inner_hi(k));
  balls_.pull_in(into);
  return into != a && into != b;
}

/// Loads the first points of along_, side by side: a kernel takes the same time for eight as for one.
void WitnessSearch::load_along(std::size_t count) noexcept {
  points_.clear();
  for (std::size_t lane = 0; lane < count; ++lane) load_claim(lane, along_[lane]);
  points_.seal(count);
}

/// Computes the middle of a segment in along_[place − 1], those of its halves at the places 2·place
/// and 2·place + 1, and so on. `between`: the middles that are not one of the ends.
void WitnessSearch::find_middles(std::size_t place, const std::vector<double>& a,
                                 const std::vector<double>& b, LaneMask& between) noexcept {
  if (place >= kLanes) return;
  std::vector<double>& middle = along_[place - 1];
  if (find_between(a, b, 0.5, middle)) between |= 1U << (place - 1);
  find_middles(2 * place, a, middle, between);
  find_middles(2 * place + 1, middle, b, between);
}

/// Halves the segment as often as middles are loaded; returns false if it was the last time.
bool WitnessSearch::move_to_middles() noexcept {
  LaneMask between = 0;
  find_middles(1, positive_.point, negative_.point, between);
  load_along(kLanes - 1);
  for (std::size_t place = 1; place < kLanes;) {
    const std::size_t lane = place - 1;
    if (!has_lane(between, lane)) return false;
    const std::optional<Interval> determinant =
        certify_lane(lane, along_[lane], false, Effort::kElimination);
    if (!determinant) return false;
    const int sign = certain_sign(*determinant);
    Candidate& side = sign > 0 ? positive_ : sign < 0 ? negative_ : nearest_;
    side.point = along_[lane];
    side.determinant = *determinant;
    if (sign == 0) {
      approach_nearest(positive_);
      approach_nearest(negative_);
      return false;
    }
    place = 2 * place + (sign > 0 ? 1 : 0);
  }
  return true;
}

/// Narrows `zero` to the part of it where the signs of eight determinants in plain doubles change;
/// returns false if none of them does.
bool WitnessSearch::narrow_by_signs(ApproxZero& zero) noexcept {
  double part[kLanes];
  const std::size_t count = zero.choose_parts(part);
  if (count == 0) return false;
  points_.clear();
  for (std::size_t lane = 0; lane < count; ++lane) {
    static_cast<void>(find_between(positive_.point, negative_.point, part[lane], along_[lane]));
    load_point(lane, along_[lane].data());
  }
  evaluate_points(count);
  if ((points_.preconditioned() & points_.loaded()) != points_.loaded()) return false;
  const double before = zero.width();
  for (std::size_t lane = 0; lane < count; ++lane)
    zero.learn(part[lane], points_.approx_determinant(lane));
  return zero.width() < before;
}

/// Halves the segment as often as plain doubles tell in which half it changes its sign. Then the
/// signs at its ends are certified, all at once; the way there needs no proof. Returns how often, a
/// multiple of kHalvingsALook.
std::size_t WitnessSearch::leap_to_zero() noexcept {
  ApproxZero zero(mid(positive_.determinant), mid(negative_.determinant));
  const std::size_t most = safe_halvings(positive_.determinant, negative_.determinant);
  for (unsigned look = 0; look < kMaxLooks && zero.approx_halvings(most) < most; ++look)
    if (!narrow_by_signs(zero)) break;
  std::size_t halvings = zero.approx_halvings(most);
  halvings -= halvings % kHalvingsALook;
  double from = 0.0, to = 1.0;  // as parts of the way; exact
  for (std::size_t k = 0; k < halvings; ++k) {
    if (!find_between(positive_.point, negative_.point, 0.5, along_[0])) return give_up_leap();
    const double middle = 0.5 * (from + to);
    const bool beyond = zero.from() >= middle;
    (beyond ? from : to) = middle;
    (beyond ? positive_ : negative_).point.swap(along_[0]);
  }
  points_.clear();
  load_claim(0, positive_.point);
  load_claim(1, negative_.point);
  points_.seal(2);
  const auto above = certify_lane(0, positive_.point, false, Effort::kElimination);
  const auto below = certify_lane(1, negative_.point, false, Effort::kElimination);
  if (!above || !below || certain_sign(*above) <= 0 || certain_sign(*below) >= 0)
    return give_up_leap();
  positive_.determinant = *above;
  negative_.determinant = *below;
  return halvings;
}

std::size_t WitnessSearch::give_up_leap() noexcept {
  positive_ = far_positive_;
  negative_ = far_negative_;
  return 0;
}

/// Shortens the segment while the sign of its middle is known, and then from both sides towards a
/// middle with an unknown sign. Each shorter pair is a separate proof: its signs are certified, and
/// so is its segment. Only signs decide, so that all instruction sets come to the same points.
void WitnessSearch::close_in() noexcept {
  // Points of the same length: no memory is needed.
  far_positive_ = positive_;
  far_negative_ = negative_;
  nearest_.determinant = kEntire;
  for (std::size_t step = leap_to_zero(); step < kMaxCloseIn && move_to_middles();
       step += kHalvingsALook)
    continue;
  if (certain_segment(positive_.point, negative_.point)) return;
  positive_ = far_positive_;
  negative_ = far_negative_;
}

/// Takes the point closest to nearest_ whose sign is certainly the same: goes away from nearest_ by
/// growing steps, then back by halves.
void WitnessSearch::approach_nearest(Candidate& side) noexcept {
  leave_nearest(side);
  return_to_nearest(side);
}

bool WitnessSearch::move_if_certain(Candidate& side, std::size_t lane) noexcept {
  const std::optional<Interval> determinant =
      certify_lane(lane, along_[lane], false, Effort::kElimination);
  if (!determinant || certain_sign(*determinant) != certain_sign(side.determinant)) return false;
  side.point = along_[lane];
  side.determinant = *determinant;
  return true;
}

void WitnessSearch::leave_nearest(Candidate& side) noexcept {
  for (double part = kNearest; part < 1.0;) {
    LaneMask between = 0;
    std::size_t count = 0;
    for (; count < kLanes && part < 1.0; ++count, part *= kGrowth)
      if (find_between(nearest_.point, side.point, part, along_[count])) between |= 1U << count;
    load_along(count);
    for (std::size_t lane = 0; lane < count; ++lane)
      if (has_lane(between, lane) && move_if_certain(side, lane)) return;
  }
}

void WitnessSearch::return_to_nearest(Candidate& side) noexcept {
  for (std::size_t step = 0; step < kMaxCloseIn;) {
    std::size_t count = 0;
    const std::vector<double>* from = &side.point;
    while (count < kLanes && step + count < kMaxCloseIn &&
           find_between(nearest_.point, *from, 0.5, along_[count]))
      from = &along_[count++];
    if (count == 0) return;
    load_along(count);
    for (std::size_t lane = 0; lane < count; ++lane)
      if (!move_if_certain(side, lane)) return;
    step += count;
  }
}

const WitnessSearch::Candidate& WitnessSearch::closest_to_zero() const noexcept {
  const auto closer = [](const Candidate& a, const Candidate& b) -> const Candidate& {
    return mag(b.determinant) < mag(a.determinant) ? b : a;
  };
  return closer(nearest_, closer(positive_, negative_));
}

void WitnessSearch::copy_pose(const std::vector<Interval>& point, std::vector<Interval>& pose) {
  pose.clear();
  if (problem_.kernel->pose == nullptr) return;
  points_.clear();
  points_.load(0, point);
  points_.seal(1);
  if (!has_lane(points_.call_on_boxes(points_.kernel().pose, pose_.get()), 0)) return;
  for (std::size_t k = 0; k < problem_.kernel->pose_parameters; ++k)
    pose.push_back({pose_[lower_at(k, 0)], pose_[upper_at(k, 0)]});
}

void WitnessSearch::report(WitnessPoint& into, const Candidate& candidate) {
  into.variables.clear();
  into.places.clear();
  for (std::size_t k = 0; k < variables_; ++k)
    into.variables.push_back(within_inner(k, candidate.point[k]));
  // With α > 0, the determinant of one point is of J⁻¹: the row scale has made it the user's.
  const bool of_kernel = reason_ == Reason::kOppositeSigns || !scaled_;
  into.determinant = of_kernel
                         ? times_power_of_two(candidate.determinant, -problem_.determinant_exponent)
                         : candidate.determinant;
  copy_pose(into.variables, into.pose);
}

void WitnessSearch::copy_point(std::size_t index, std::span<Interval> variables) const noexcept {
  const Candidate& candidate = points() == 1 ? small_ : index == 0 ? positive_ : negative_;
  for (std::size_t k = 0; k < variables_; ++k) variables[k] = within_inner(k, candidate.point[k]);
}

/// Uses the same vectors each time, so they grow only once.
const Witness& WitnessSearch::witness() {
  if (found_at_ends_) {
    witness_.points.resize(1);
    report_ends(witness_.points.front());
    if (closes_in_) witness_.near = witness_.points.front();
    return witness_;
  }
  const bool small = reason_ == Reason::kSmallDeterminant;
  witness_.points.resize(small ? 1 : 2);
  report(witness_.points[0], small ? small_ : positive_);
  if (!small) report(witness_.points[1], negative_);
  if (!closes_in_) return witness_;
  if (!witness_.near) witness_.near.emplace();
  report(*witness_.near, small ? small_ : closest_to_zero());
  return witness_;
}

}  // namespace regulus::detail
