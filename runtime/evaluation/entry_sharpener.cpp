// SPDX-License-Identifier: Apache-2.0
// Entries of the method's matrix, sharpened by enclosures of their derivatives over the box.
//
// Let D_k enclose ∂_k f over a box on which f and its derivatives are defined.
//  - f(x) ∈ f(c) + Σ D_k·(x_k − c_k) for the midpoint c (mean value).
//  - Where D_k ≥ 0, moving x_k to its lower end does not raise f, and x stays in the box, where the
//    signs of all D hold still. Doing so for one variable after another (to the upper end where
//    D_k ≤ 0) shows that f is nowhere below its least value on that face of the box (Merlet, T-RO
//    2007, §II-A: x² − 2x over [3, 5]). The opposite face bounds f from above.
#include "runtime/evaluation/entry_sharpener.hpp"

#include <algorithm>

#include "runtime/regularity/lanes.hpp"

namespace regulus::detail {

EntrySharpener::EntrySharpener(const BoxLanes& lanes, MidpointEvaluator& midpoint,
                               DerivativeEvaluator& derivatives, MatrixEvaluator& matrix)
    : lanes_(lanes),
      midpoint_(midpoint),
      derivatives_(derivatives),
      matrix_(matrix),
      count_(std::size_t{lanes.kernel().columns} * lanes.kernel().columns),
      face_boxes_(2 * lanes.variables() * kLanes),
      face_points_(std::size_t{lanes.kernel().rows} * lanes.kernel().columns * kLanes),
      entries_(2 * count_ * kLanes) {}

void EntrySharpener::sharpen(IntervalMatrix entries, LaneMask lanes) noexcept {
  lanes &= derivatives_.defined();
  if (lanes == 0) return;
  intersect_with_mean_value(entries, lanes);
  for_each_lane(lanes, [&](std::size_t lane) { add_lane(entries, lane); });
  if (faces_ > 0) evaluate_faces(entries);
}

IntervalMatrix EntrySharpener::found() noexcept {
  const std::size_t n = lanes_.kernel().columns;
  return IntervalMatrix(entries_.get(), n, n);
}

void EntrySharpener::intersect_with_mean_value(IntervalMatrix entries, LaneMask lanes) noexcept {
  const std::size_t variables = lanes_.variables();
  const ConstIntervalMatrix D = derivatives_.derivatives();
  const ConstPointVector radius = lanes_.radii();
  const IntervalMatrix center = found();
  const double factor = raise_factor(variables);
  lanes &= matrix_.evaluate(lanes_.thin(), midpoint_.preconditioner(), center);
  for (std::size_t e = 0; e < count_; ++e) {
    double spread[kLanes] = {};
    for (std::size_t k = 0; k < variables; ++k)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::size_t d = k * count_ + e;
        spread[lane] += std::max(-D.lower(d, lane), D.upper(d, lane)) * radius.at(k, lane);
      }
    for_each_lane(lanes, [&](std::size_t lane) {
      const double spread_ru = raise_ru(spread[lane], factor);
      double& lo = entries.lower(e, lane);
      double& hi = entries.upper(e, lane);
      lo = std::max(lo, sub_rd(center.lower(e, lane), spread_ru));
      hi = std::min(hi, add_ru(center.upper(e, lane), spread_ru));
    });
  }
}

void EntrySharpener::add_lane(IntervalMatrix entries, std::size_t lane) noexcept {
  for (std::size_t e = 0; e < count_; ++e) trend_[lane][e] = trend_of(e, lane);
  for (std::size_t e = 0; e < count_; ++e) {
    const Trend trend = trend_[lane][e];
    if (trend.empty() || seen_before(e, lane)) continue;
    add_face(entries, lane, trend);
    add_face(entries, lane, trend.opposite());
  }
}

EntrySharpener::Trend EntrySharpener::trend_of(std::size_t e, std::size_t lane) const noexcept {
  Trend trend;
  const ConstIntervalMatrix D = derivatives_.derivatives();
  for (std::size_t k = 0; k < std::min(lanes_.variables(), kMaxMonotone); ++k) {
    const double lo = D.lower(k * count_ + e, lane);
    const double hi = D.upper(k * count_ + e, lane);
    if ((lo == 0.0 && hi == 0.0) || lanes_.radii().at(k, lane) == 0.0) continue;
    if (lo >= 0.0) trend.rising |= std::uint64_t{1} << k;
    if (hi <= 0.0) trend.falling |= std::uint64_t{1} << k;
  }
  return trend;
}

bool EntrySharpener::seen_before(std::size_t e, std::size_t lane) const noexcept {
  const Trend trend = trend_[lane][e];
  const Trend opposite = trend.opposite();
  return std::any_of(trend_[lane], trend_[lane] + e,
                     [&](const Trend& earlier) { return earlier == trend || earlier == opposite; });
}

/// Adds the face on which entries of this trend are least.
void EntrySharpener::add_face(IntervalMatrix entries, std::size_t lane, Trend trend) noexcept {
  for (std::size_t k = 0; k < lanes_.variables(); ++k) {
    const double lo = lanes_.boxes().lower(k, lane);
    const double hi = lanes_.boxes().upper(k, lane);
    const std::uint64_t bit = k < kMaxMonotone ? std::uint64_t{1} << k : 0;
    face_boxes_[lower_at(k, faces_)] = (trend.falling & bit) != 0 ? hi : lo;
    face_boxes_[upper_at(k, faces_)] = (trend.rising & bit) != 0 ? lo : hi;
  }
  const ConstPointMatrix K = midpoint_.preconditioner();
  for (std::size_t p = 0; p < K.size(); ++p) face_points_[point_at(p, faces_)] = K.at(p, lane);
  face_lane_[faces_] = lane;
  face_trend_[faces_] = trend;
  if (++faces_ == kLanes) evaluate_faces(entries);
}

void EntrySharpener::evaluate_faces(IntervalMatrix entries) noexcept {
  fill_up();
  const ConstPointMatrix K = midpoint_.preconditioner();
  const IntervalMatrix on_face = found();
  const LaneMask defined =
      matrix_.evaluate(ConstIntervalVector(face_boxes_.get(), lanes_.variables()),
                       ConstPointMatrix(face_points_.get(), K.rows(), K.columns()), on_face);
  for (std::size_t f = 0; f < faces_; ++f) {
    if (!has_lane(defined, f)) continue;
    const std::size_t lane = face_lane_[f];
    for (std::size_t e = 0; e < count_; ++e) {
      double& lo = entries.lower(e, lane);
      double& hi = entries.upper(e, lane);
      const Trend trend = trend_[lane][e];
      if (trend == face_trend_[f]) lo = std::max(lo, on_face.lower(e, f));
      if (trend == face_trend_[f].opposite()) hi = std::min(hi, on_face.upper(e, f));
    }
  }
  faces_ = 0;
}

/// Fills the other lanes: kernels need eight proper boxes.
void EntrySharpener::fill_up() noexcept {
  const std::size_t points = midpoint_.preconditioner().size();
  for (std::size_t f = faces_; f < kLanes; ++f) {
    for (std::size_t k = 0; k < 2 * lanes_.variables(); ++k)
      face_boxes_[point_at(k, f)] = face_boxes_[point_at(k, 0)];
    for (std::size_t p = 0; p < points; ++p)
      face_points_[point_at(p, f)] = face_points_[point_at(p, 0)];
  }
}

}  // namespace regulus::detail
