// SPDX-License-Identifier: Apache-2.0
#include "runtime/witness/witness_search.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/regularity/determinant.hpp"

namespace regulus::detail {
namespace {

/// A failed proof of opposite signs is repeated if a candidate is better by this factor.
constexpr double kWorthAnotherTry = 2.0;

/// The largest number of proofs that are tried at points of small determinant.
constexpr unsigned kMaxSmallTries = 64;

std::vector<std::optional<Interval>> reach_of(const Problem& problem, const ToleranceBalls& balls) {
  std::vector<std::optional<Interval>> reach = problem.inner;
  for (std::size_t k = 0; k < reach.size(); ++k)
    if (const std::optional<Interval> axis = balls.axis(k)) reach[k] = axis;
  return reach;
}

}  // namespace

WitnessSearch::WitnessSearch(const Problem& problem, const Settings& settings, bool closes_in)
    : problem_(problem),
      settings_(settings),
      oracle_(settings.oracle),
      algebra_(settings.algebra),
      variables_(problem.kernel->variables),
      square_(problem.kernel->rows == problem.kernel->columns),
      scaled_(problem.alpha.hi > 0.0),
      uses_corners_(settings.ingredients.corners),
      uses_descents_(settings.ingredients.descents),
      closes_in_(closes_in),
      balls_(problem),
      reach_(reach_of(problem, balls_)),
      inner_(reach_),
      points_(problem, settings, no_structure_),
      pose_(2 * std::size_t{problem.kernel->pose_parameters} * kLanes),
      box_(variables_),
      in_ball_(variables_),
      current_(variables_),
      moved_(variables_),
      downhill_(variables_),
      places_(variables_),
      at_ends_(variables_) {
  for (Candidate* candidate :
       {&positive_, &negative_, &small_, &nearest_, &far_positive_, &far_negative_})
    candidate->point.resize(variables_);
  for (std::vector<double>& point : along_) point.resize(variables_);
  for (Start& start : starts_) start.point.resize(variables_);
  note_balls();
  witness_.points.reserve(2);
}

void WitnessSearch::note_balls() {
  for (std::size_t k = 0; k < variables_; ++k) in_ball_[k] = balls_.axis(k).has_value();
}

void WitnessSearch::take_ranges() {
  balls_ = ToleranceBalls(problem_);
  reach_ = reach_of(problem_, balls_);
  note_balls();
}

void WitnessSearch::restart() noexcept {
  forget();
  oracle_ = settings_.oracle;
  algebra_ = settings_.algebra;
  probes_ = 0;
}

void WitnessSearch::forget() noexcept {
  for (Candidate* candidate : {&positive_, &negative_, &small_})
    candidate->approx = candidate->tried = 0.0;
  small_known_ = small_fresh_ = found_ = found_at_ends_ = false;
  small_tries_ = 0;
  inner_ = reach_;  // of the same size: no memory is needed
}

void WitnessSearch::copy_candidates(WitnessCandidates& into) const {
  into.positive = positive_;
  into.negative = negative_;
  into.small = small_;
  into.small_known = small_known_;
  into.small_fresh = small_fresh_;
  into.small_tries = small_tries_;
}

void WitnessSearch::look_on_from(const WitnessCandidates& candidates) {
  const auto take = [this](const WitnessCandidates::Candidate& from, Candidate& to) {
    if (from.point.size() != variables_) return false;
    static_cast<WitnessCandidates::Candidate&>(to) = from;
    return true;
  };
  static_cast<void>(take(candidates.positive, positive_));
  static_cast<void>(take(candidates.negative, negative_));
  if (!take(candidates.small, small_)) return;
  small_known_ = candidates.small_known;
  small_fresh_ = candidates.small_fresh;
  small_tries_ = candidates.small_tries;
}

bool WitnessSearch::look_inside(std::span<const Interval> box) noexcept {
  forget();
  for (std::size_t k = 0; k < variables_; ++k) {
    const auto& inner = reach_[k];
    inner_[k] = inner ? intersect(*inner, box[k]) : std::nullopt;
    if (inner && !inner_[k]) return false;
  }
  descend(box);
  if (!found_) look_at_corners();
  return found_;
}

double WitnessSearch::inner_lo(std::size_t variable) const noexcept {
  const auto& inner = inner_[variable];
  return inner ? inner->lo : mid(problem_.outer[variable]);
}

double WitnessSearch::inner_hi(std::size_t variable) const noexcept {
  const auto& inner = inner_[variable];
  return inner ? inner->hi : mid(problem_.outer[variable]);
}

Interval WitnessSearch::within_inner(std::size_t variable, double x) const noexcept {
  const auto& inner = inner_[variable];
  return inner ? Interval(std::clamp(x, inner->lo, inner->hi)) : problem_.outer[variable];
}

/// Moves the point into the ranges and the balls.
void WitnessSearch::load_point(std::size_t lane, const double* point) noexcept {
  for (std::size_t k = 0; k < variables_; ++k)
    moved_[k] = std::clamp(point[k], inner_lo(k), inner_hi(k));
  balls_.pull_in(moved_);
  for (std::size_t k = 0; k < variables_; ++k) box_[k] = within_inner(k, moved_[k]);
  points_.load(lane, box_);
}

void WitnessSearch::evaluate_points(std::size_t count) noexcept {
  points_.seal(count);
  probes_ += count;
}

double WitnessSearch::approx_objective(std::size_t lane) noexcept {
  const double determinant = points_.approx_determinant(lane);
  return scaled_ ? determinant * points_.approx_row_scale(lane) : determinant;
}

template <typename Middle>
void WitnessSearch::copy_middle(Middle middle, Candidate& candidate) noexcept {
  for (std::size_t k = 0; k < variables_; ++k)
    candidate.point[k] = std::clamp(middle(k), inner_lo(k), inner_hi(k));
  balls_.pull_in(candidate.point);
}

/// Takes the approximate determinant at a point, and the point's coordinate k as middle(k).
template <typename Middle>
void WitnessSearch::offer(double approx, Middle middle) noexcept {
  Candidate& side = approx > 0.0 ? positive_ : negative_;
  if (approx != 0.0 && std::fabs(approx) > std::fabs(side.approx)) {
    copy_middle(middle, side);
    side.approx = approx;
  }
  const double magnitude = std::fabs(approx);
  if (magnitude <= problem_.alpha.lo && (!small_known_ || magnitude <= small_.approx)) {
    copy_middle(middle, small_);
    small_.approx = magnitude;
    small_known_ = small_fresh_ = true;
  }
}

void WitnessSearch::look_at_midpoints(Decisions& batch) noexcept {
  if (!square_ || found_) return;
  const MidpointDeterminants& seen = batch.midpoint_determinants;
  for_each_lane(seen.lanes, [&](std::size_t lane) {
    const std::span<const Interval> box = batch.box_of(lane);
    offer(seen.approx[lane],
          [box](std::size_t k) { return box[k].lo == box[k].hi ? box[k].lo : mid(box[k]); });
  });
  try_small();
  try_opposite_signs();
}

/// Does the same for the loaded points.
void WitnessSearch::look_at_points(LaneMask lanes) noexcept {
  if (!square_ || found_) return;
  const MidpointDeterminants seen = approx_midpoint_determinants(points_, lanes, scaled_);
  for_each_lane(seen.lanes, [&](std::size_t lane) {
    offer(seen.approx[lane], [this, lane](std::size_t k) { return points_.midpoint(k, lane); });
  });
  try_small();
  try_opposite_signs();
}

void WitnessSearch::look_at(std::span<const std::vector<double>> points) noexcept {
  for (std::size_t other = 0; other < points.size() && !found_; ++other) {
    forget();
    points_.clear();
    load_point(0, points[0].data());
    load_point(1, points[other].data());
    evaluate_points(2);
    look_at_points(points_.loaded());
  }
}

void WitnessSearch::try_small() noexcept {
  if (found_ || !small_fresh_ || small_tries_ == kMaxSmallTries) return;
  small_fresh_ = false;
  ++small_tries_;
  const std::optional<Interval> determinant = certify_point(small_.point, true);
  if (!determinant || !(mag(*determinant) <= problem_.alpha.lo)) return;
  small_.determinant = *determinant;
  reason_ = Reason::kSmallDeterminant;
  found_ = true;
}

void WitnessSearch::try_opposite_signs() noexcept {
  if (found_ || positive_.approx == 0.0 || negative_.approx == 0.0) return;
  if (positive_.approx < kWorthAnotherTry * positive_.tried &&
      -negative_.approx < kWorthAnotherTry * negative_.tried)
    return;
  positive_.tried = positive_.approx;
  negative_.tried = -negative_.approx;
  const std::optional<Interval> above = certify_point(positive_.point, false);
  const std::optional<Interval> below = certify_point(negative_.point, false);
  if (!above || !below || certain_sign(*above) <= 0 || certain_sign(*below) >= 0) return;
  if (!certain_segment(positive_.point, negative_.point)) return;
  positive_.determinant = *above;
  negative_.determinant = *below;
  reason_ = Reason::kOppositeSigns;
  found_ = true;
  if (closes_in_) close_in();
}

Interval WitnessSearch::enclose_at(std::size_t lane, bool scaled, Effort effort) noexcept {
  LaneMask defined = 1U << lane;
  const ConstIntervalMatrix matrix = points_.product({}, defined);
  if (defined == 0) return kEntire;
  const LaneMatrix M = matrix_of_lane(matrix, lane);
  Interval determinant = enclose_determinant_by_elimination(M);
  // More digits decide more than the expansion, in less time.
  if (effort == Effort::kAll && certain_sign(determinant) == 0 && oracle_ == nullptr)
    determinant = intersect(determinant, enclose_determinant(M)).value_or(determinant);
  return scaled ? determinant * points_.row_scale(lane) : determinant;
}

/// Loads a point about which something may be claimed: the point itself, not one that was moved.
void WitnessSearch::load_claim(std::size_t lane, const std::vector<double>& point) noexcept {
  load_point(lane, point.data());
  const bool itself = moved_ == point && balls_.certain_inside(point);
  claimable_ = (claimable_ & ~(1U << lane)) | LaneMask{itself} << lane;
}

/// Encloses det A (with row scales: det J⁻¹) at a point; nullopt if the point is not certainly in
/// the variety or J⁻¹ not certainly defined there.
std::optional<Interval> WitnessSearch::certify_point(const std::vector<double>& point,
                                                     bool scaled) noexcept {
  points_.clear();
  load_claim(0, point);
  points_.seal(1);
  return certify_lane(0, point, scaled, Effort::kAll);
}

/// The same for a point that load_claim has loaded.
std::optional<Interval> WitnessSearch::certify_lane(std::size_t lane,
                                                    const std::vector<double>& point, bool scaled,
                                                    Effort effort) noexcept {
  if (!has_lane(claimable_, lane)) return std::nullopt;
  ++probes_;
  LaneMask defined = points_.certain_inside() & points_.certain_posed() & 1U << lane;
  static_cast<void>(points_.product({}, defined));
  if (defined == 0) return std::nullopt;
  const Interval determinant = enclose_at(lane, scaled, effort);
  const bool decided = certain_sign(determinant) != 0 || mag(determinant) <= problem_.alpha.lo;
  if (decided || oracle_ == nullptr) return determinant;
  for (std::size_t k = 0; k < variables_; ++k) box_[k] = within_inner(k, point[k]);
  const std::optional<Interval> sharper = oracle_->enclose(box_);
  if (!sharper) return determinant;
  return scaled ? *sharper * points_.row_scale(lane) : *sharper;
}

}  // namespace regulus::detail
