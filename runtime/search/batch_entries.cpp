// SPDX-License-Identifier: Apache-2.0
// Entries of the method's matrix, sharpened by enclosures of their derivatives over the box.
//
// Let D_k enclose ∂_k f over a box on which f and its derivatives are defined.
//  - f(x) ∈ f(c) + Σ D_k·(x_k − c_k) for the midpoint c (mean value).
//  - Where D_k ≥ 0, moving x_k to its lower end does not raise f, and x stays in the box, where the
//    signs of all D hold still. Doing so for one variable after another (to the upper end where
//    D_k ≤ 0) shows that f is nowhere below its least value on that face of the box (Merlet, T-RO
//    2007, §II-A: x² − 2x over [3, 5]). The opposite face bounds f from above.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "regulus/regularity/lanes.hpp"
#include "regulus/search/batch.hpp"

namespace regulus {
namespace {

/// Variables beyond these are taken as not monotone.
constexpr std::size_t kMaxMonotone = 64;

/// The variables an entry rises and falls with, as bits; none where it does not depend on one.
struct Trend {
  std::uint64_t rising = 0;
  std::uint64_t falling = 0;

  [[nodiscard]] bool empty() const noexcept { return (rising | falling) == 0; }
  [[nodiscard]] Trend opposite() const noexcept { return {falling, rising}; }
  friend bool operator==(const Trend&, const Trend&) = default;
};

constexpr std::size_t kMaxEntries = kMaxColumns * kMaxColumns;

}  // namespace

/// ∂_k of the method's matrix over the boxes; the lanes in which they are enclosed.
LaneMask Batch::derivatives_of_product() noexcept {
  using Side = ProductForm::Side;
  if (form_ == ProductForm{Side::kLeft, false} && kernel_.left_derivatives != nullptr)
    return preconditioned() &
           call(kernel_.left_derivatives, boxes_.get(), preconditioner(), derivatives_.get());
  double* of_matrix = form_.side == Side::kNone ? derivatives_.get() : matrix_derivatives_.get();
  const LaneMask defined = call(kernel_.matrix_derivatives, boxes_.get(), nullptr, of_matrix);
  if (form_.side == Side::kNone) return defined;
  const std::size_t entries = 2 * columns_ * columns_ * kLanes;
  for (std::size_t k = 0; k < variables_; ++k) {
    const double* from = of_matrix + k * entries;
    double* to = derivatives_.get() + k * entries;
    form_.side == Side::kLeft ? multiply_left(from, preconditioner(), to)
                              : multiply_right(from, preconditioner(), to);
  }
  return defined & preconditioned();
}

void Batch::compute_derivatives() noexcept {
  if (begin(kDerivatives)) derivatives_defined_ = derivatives_of_product();
}

void Batch::sharpen(double* entries, LaneMask lanes) noexcept {
  compute_derivatives();
  lanes &= derivatives_defined_;
  if (lanes == 0) return;
  intersect_with_mean_value(entries, lanes);
  intersect_with_faces(entries, lanes);
}

void Batch::intersect_with_mean_value(double* entries, LaneMask lanes) noexcept {
  const std::size_t count = columns_ * columns_;
  const double factor = raise_factor(variables_);
  lanes &= product_on(thin_.get(), preconditioner(), scratch_.get());
  for (std::size_t e = 0; e < count; ++e) {
    double spread[kLanes] = {};
    for (std::size_t k = 0; k < variables_; ++k)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::size_t d = k * count + e;
        spread[lane] +=
            std::max(-derivatives_[lower_at(d, lane)], derivatives_[upper_at(d, lane)]) *
            radius_[point_at(k, lane)];
      }
    for_each_lane(lanes, [&](std::size_t lane) {
      const double spread_ru = raise_ru(spread[lane], factor);
      double& lo = entries[lower_at(e, lane)];
      double& hi = entries[upper_at(e, lane)];
      lo = std::max(lo, sub_rd(scratch_[lower_at(e, lane)], spread_ru));
      hi = std::min(hi, add_ru(scratch_[upper_at(e, lane)], spread_ru));
    });
  }
}

/// Collects faces of the boxes of a batch and evaluates them eight at a time. Entries of one trend
/// share their faces, and the lower face of one trend is the upper face of its opposite.
class FaceEvaluation {
 public:
  FaceEvaluation(Batch& batch, double* entries) noexcept
      : batch_(batch), entries_(entries), count_(batch.columns_ * batch.columns_) {}

  void add_lane(std::size_t lane) noexcept {
    for (std::size_t e = 0; e < count_; ++e) trend_[lane][e] = trend_of(e, lane);
    for (std::size_t e = 0; e < count_; ++e) {
      const Trend trend = trend_[lane][e];
      if (trend.empty() || seen_before(e, lane)) continue;
      add_face(lane, trend);
      add_face(lane, trend.opposite());
    }
  }
  void finish() noexcept {
    if (faces_ > 0) evaluate();
  }

 private:
  [[nodiscard]] Trend trend_of(std::size_t e, std::size_t lane) const noexcept {
    Trend trend;
    for (std::size_t k = 0; k < std::min(batch_.variables_, kMaxMonotone); ++k) {
      const double lo = batch_.derivatives_[lower_at(k * count_ + e, lane)];
      const double hi = batch_.derivatives_[upper_at(k * count_ + e, lane)];
      if ((lo == 0.0 && hi == 0.0) || batch_.radius_[point_at(k, lane)] == 0.0) continue;
      if (lo >= 0.0) trend.rising |= std::uint64_t{1} << k;
      if (hi <= 0.0) trend.falling |= std::uint64_t{1} << k;
    }
    return trend;
  }

  [[nodiscard]] bool seen_before(std::size_t e, std::size_t lane) const noexcept {
    const Trend trend = trend_[lane][e];
    const Trend opposite = trend.opposite();
    return std::any_of(trend_[lane], trend_[lane] + e, [&](const Trend& earlier) {
      return earlier == trend || earlier == opposite;
    });
  }

  /// The face on which entries of this trend are least.
  void add_face(std::size_t lane, Trend trend) noexcept {
    for (std::size_t k = 0; k < batch_.variables_; ++k) {
      const double lo = batch_.boxes_[lower_at(k, lane)];
      const double hi = batch_.boxes_[upper_at(k, lane)];
      const std::uint64_t bit = k < kMaxMonotone ? std::uint64_t{1} << k : 0;
      batch_.face_boxes_[lower_at(k, faces_)] = (trend.falling & bit) != 0 ? hi : lo;
      batch_.face_boxes_[upper_at(k, faces_)] = (trend.rising & bit) != 0 ? lo : hi;
    }
    const double* K = batch_.preconditioner();
    for (std::size_t p = 0; p < batch_.rows_ * batch_.columns_; ++p)
      batch_.face_points_[point_at(p, faces_)] = K[point_at(p, lane)];
    face_lane_[faces_] = lane;
    face_trend_[faces_] = trend;
    if (++faces_ == kLanes) evaluate();
  }

  void evaluate() noexcept {
    fill_up();
    const double* found = batch_.face_entries_.get();
    const LaneMask defined = batch_.product_on(batch_.face_boxes_.get(), batch_.face_points_.get(),
                                               batch_.face_entries_.get());
    for (std::size_t f = 0; f < faces_; ++f) {
      if (!has_lane(defined, f)) continue;
      const std::size_t lane = face_lane_[f];
      for (std::size_t e = 0; e < count_; ++e) {
        double& lo = entries_[lower_at(e, lane)];
        double& hi = entries_[upper_at(e, lane)];
        const Trend trend = trend_[lane][e];
        if (trend == face_trend_[f]) lo = std::max(lo, found[lower_at(e, f)]);
        if (trend == face_trend_[f].opposite()) hi = std::min(hi, found[upper_at(e, f)]);
      }
    }
    faces_ = 0;
  }

  /// Kernels want eight proper boxes.
  void fill_up() noexcept {
    for (std::size_t f = faces_; f < kLanes; ++f) {
      for (std::size_t k = 0; k < 2 * batch_.variables_; ++k)
        batch_.face_boxes_[point_at(k, f)] = batch_.face_boxes_[point_at(k, 0)];
      for (std::size_t p = 0; p < batch_.rows_ * batch_.columns_; ++p)
        batch_.face_points_[point_at(p, f)] = batch_.face_points_[point_at(p, 0)];
    }
  }

  Batch& batch_;
  double* entries_;
  const std::size_t count_;
  std::size_t faces_ = 0;
  std::size_t face_lane_[kLanes];
  Trend face_trend_[kLanes];
  Trend trend_[kLanes][kMaxEntries];
};

void Batch::intersect_with_faces(double* entries, LaneMask lanes) noexcept {
  FaceEvaluation faces(*this, entries);
  for_each_lane(lanes, [&](std::size_t lane) { faces.add_lane(lane); });
  faces.finish();
}

}  // namespace regulus
