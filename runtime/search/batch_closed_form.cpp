// SPDX-License-Identifier: Apache-2.0
// The determinant in closed form over the boxes of a batch. With D_k ∋ ∂_k det over the whole box
// and any centre c in it, the mean value theorem gives
//
//   det(x) ≥ det(c) − Σ_k max(−D_k.lo·(X_k.hi − c_k), D_k.hi·(c_k − X_k.lo), 0)
//
// A variable in which det certainly grows or falls has its c_k at an end and costs nothing; then
// the natural enclosure over that face is a bound, too. Upper bounds are lower bounds of −det.
#include <algorithm>
#include <cmath>

#include "regulus/search/batch.hpp"

namespace regulus {
namespace {

Interval entry(const double* x, std::size_t e, std::size_t lane) noexcept {
  return {x[lower_at(e, lane)], x[upper_at(e, lane)]};
}

void store(double* x, std::size_t e, std::size_t lane, Interval value) noexcept {
  x[lower_at(e, lane)] = value.lo;
  x[upper_at(e, lane)] = value.hi;
}

/// Where the two losses of a variable are equal, roughly; any centre is sound.
/// Source    Baumann, Optimal centered forms, BIT 28, 1988.
double approx_best_center(Interval x, Interval slope) noexcept {
  if (slope.lo >= 0.0) return x.lo;
  if (slope.hi <= 0.0) return x.hi;
  const double part = slope.hi / (slope.hi - slope.lo);
  const double center = x.hi + part * (x.lo - x.hi);
  return x.lo <= center && center <= x.hi ? center : mid(x);
}

/// What the mean value form loses to one variable.
double loss_ru(Interval x, Interval slope, double center) noexcept {
  const double above = mul_ru(std::max(-slope.lo, 0.0), sub_ru(x.hi, center));
  const double below = mul_ru(std::max(slope.hi, 0.0), sub_ru(center, x.lo));
  return std::max(above, below);
}

Interval oriented(Interval x, bool least) noexcept { return least ? x : -x; }

}  // namespace

const double* Batch::natural_determinant() noexcept {
  if (!begin(kDeterminant)) return determinant_.get();
  const LaneMask defined = call(kernel_.determinant, boxes_.get(), nullptr, determinant_.get());
  for_each_lane(kAllLanes & ~defined,
                [this](std::size_t lane) { store(determinant_.get(), 0, lane, kEntire); });
  return determinant_.get();
}

void Batch::compute_determinant_derivatives() noexcept {
  if (!begin(kDeterminantDerivatives)) return;
  determinant_slopes_defined_ =
      call(kernel_.determinant_derivatives, boxes_.get(), nullptr, determinant_slopes_.get());
}

const double* Batch::monotone_determinant() noexcept {
  if (!begin(kMonotone)) return monotone_.get();
  std::copy_n(natural_determinant(), 2 * kLanes, monotone_.get());
  compute_determinant_derivatives();
  for (const bool least : {true, false}) {
    load_face(least);
    narrow_on_face(least);
  }
  return monotone_.get();
}

/// The centres that suit lower bounds of det, or of −det, and the faces they lie on.
void Batch::load_face(bool least) noexcept {
  for (std::size_t k = 0; k < variables_; ++k)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const Interval x = box(k, lane);
      const Interval slope = oriented(entry(determinant_slopes_.get(), k, lane), least);
      const double center = approx_best_center(x, slope);
      const bool monotone = !(slope.lo < 0.0 && slope.hi > 0.0);
      store(face_.get(), k, lane, monotone ? Interval(center) : x);
      store(face_center_.get(), k, lane, Interval(center));
    }
}

void Batch::narrow_on_face(bool least) noexcept {
  double on_face[2 * kLanes];
  LaneMask defined = determinant_slopes_defined_;
  defined &= call(kernel_.determinant, face_.get(), nullptr, scratch_.get());
  std::copy_n(scratch_.get(), 2 * kLanes, on_face);
  defined &= call(kernel_.determinant, face_center_.get(), nullptr, scratch_.get());
  for_each_lane(defined & loaded_, [&](std::size_t lane) {
    double loss = 0.0;
    for (std::size_t k = 0; k < variables_; ++k)
      loss = add_ru(
          loss, loss_ru(box(k, lane), oriented(entry(determinant_slopes_.get(), k, lane), least),
                        face_center_[lower_at(k, lane)]));
    const double by_center = sub_rd(oriented(entry(scratch_.get(), 0, lane), least).lo, loss);
    const double by_face = oriented(entry(on_face, 0, lane), least).lo;
    Interval known = oriented(entry(monotone_.get(), 0, lane), least);
    known.lo = std::max({known.lo, by_center, by_face});
    store(monotone_.get(), 0, lane, oriented(known, least));
  });
}

void Batch::impact_on_determinant() noexcept {
  std::fill_n(impact_.get(), variables_ * kLanes, 0.0);
  if (kernel_.determinant_derivatives == nullptr) return;
  compute_determinant_derivatives();
  for (std::size_t k = 0; k < splittable_; ++k)
    for_each_lane(determinant_slopes_defined_ & loaded_, [&](std::size_t lane) {
      impact_[point_at(k, lane)] =
          mag(entry(determinant_slopes_.get(), k, lane)) * radius_[point_at(k, lane)];
    });
}

}  // namespace regulus
