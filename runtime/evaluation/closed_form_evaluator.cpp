// SPDX-License-Identifier: Apache-2.0
// The determinant in closed form over boxes. With D_k ∋ ∂_k det over the whole box
// and any centre c in it, the mean value theorem gives
//
//   det(x) ≥ det(c) − Σ_k max(−D_k.lo·(X_k.hi − c_k), D_k.hi·(c_k − X_k.lo), 0)
//
// A variable in which det certainly grows or falls has its c_k at an end and costs nothing; then
// the natural enclosure over that face is a bound, too. Upper bounds are lower bounds of −det.
#include "runtime/evaluation/closed_form_evaluator.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail {
namespace {

Interval entry(const AlignedBuffer& x, std::size_t e, std::size_t lane) noexcept {
  return {x[lower_at(e, lane)], x[upper_at(e, lane)]};
}

void store(AlignedBuffer& x, std::size_t e, std::size_t lane, Interval value) noexcept {
  x[lower_at(e, lane)] = value.lo;
  x[upper_at(e, lane)] = value.hi;
}

/// The centre at which the two losses of a variable are roughly equal; any centre is sound.
/// Source    Baumann, Optimal centered forms, BIT 28, 1988.
double approx_best_center(Interval x, Interval slope) noexcept {
  if (slope.lo >= 0.0) return x.lo;
  if (slope.hi <= 0.0) return x.hi;
  const double part = slope.hi / (slope.hi - slope.lo);
  const double center = x.hi + part * (x.lo - x.hi);
  return x.lo <= center && center <= x.hi ? center : mid(x);
}

/// Returns how much one variable takes from the bound of the mean value form.
double loss_ru(Interval x, Interval slope, double center) noexcept {
  const double above = mul_ru(std::max(-slope.lo, 0.0), sub_ru(x.hi, center));
  const double below = mul_ru(std::max(slope.hi, 0.0), sub_ru(center, x.lo));
  return std::max(above, below);
}

Interval oriented(Interval x, bool least) noexcept { return least ? x : -x; }

}  // namespace

ClosedFormEvaluator::ClosedFormEvaluator(const BoxLanes& lanes, const EvaluationPlan& plan)
    : lanes_(lanes),
      kernel_(lanes.kernel()),
      variables_(lanes.variables()),
      splittable_(plan.splittable),
      determinant_(2 * kLanes),
      monotone_(2 * kLanes),
      on_face_(2 * kLanes),
      on_center_(2 * kLanes) {
  if (!plan.sees_determinant) return;
  for (AlignedBuffer* buffer : {&slopes_, &face_, &face_center_})
    *buffer = AlignedBuffer(2 * variables_ * kLanes);
}

void ClosedFormEvaluator::forget() noexcept {
  for (Once* once : {&natural_known_, &monotone_known_, &slopes_known_}) once->forget();
}

ConstIntervalVector ClosedFormEvaluator::natural() noexcept {
  const ConstIntervalVector determinant(determinant_.get(), 1);
  if (!natural_known_.begin()) return determinant;
  const LaneMask defined =
      lanes_.call(kernel_.determinant, lanes_.boxes(), nullptr, determinant_.get());
  for_each_lane(kAllLanes & ~defined,
                [this](std::size_t lane) { store(determinant_, 0, lane, kEntire); });
  return determinant;
}

void ClosedFormEvaluator::compute_derivatives() noexcept {
  if (slopes_known_.begin())
    slopes_defined_ =
        lanes_.call(kernel_.determinant_derivatives, lanes_.boxes(), nullptr, slopes_.get());
}

ConstIntervalVector ClosedFormEvaluator::monotone() noexcept {
  const ConstIntervalVector result(monotone_.get(), 1);
  if (!monotone_known_.begin()) return result;
  std::copy_n(natural().data(), 2 * kLanes, monotone_.get());
  compute_derivatives();
  for (const bool least : {true, false}) {
    load_face(least);
    narrow_on_face(least);
  }
  return result;
}

/// Loads the centres for lower bounds of det, or of −det, and the faces on which they lie.
void ClosedFormEvaluator::load_face(bool least) noexcept {
  for (std::size_t k = 0; k < variables_; ++k)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const Interval x = lanes_.box(k, lane);
      const Interval slope = oriented(entry(slopes_, k, lane), least);
      const double center = approx_best_center(x, slope);
      const bool monotone = !(slope.lo < 0.0 && slope.hi > 0.0);
      store(face_, k, lane, monotone ? Interval(center) : x);
      store(face_center_, k, lane, Interval(center));
    }
}

void ClosedFormEvaluator::narrow_on_face(bool least) noexcept {
  const ConstIntervalVector face(face_.get(), variables_), center(face_center_.get(), variables_);
  LaneMask defined = slopes_defined_;
  defined &= lanes_.call(kernel_.determinant, face, nullptr, on_face_.get());
  defined &= lanes_.call(kernel_.determinant, center, nullptr, on_center_.get());
  for_each_lane(defined & lanes_.loaded(), [&](std::size_t lane) {
    double loss = 0.0;
    for (std::size_t k = 0; k < variables_; ++k)
      loss = add_ru(loss, loss_ru(lanes_.box(k, lane), oriented(entry(slopes_, k, lane), least),
                                  center.lower(k, lane)));
    const double by_center = sub_rd(oriented(entry(on_center_, 0, lane), least).lo, loss);
    const double by_face = oriented(entry(on_face_, 0, lane), least).lo;
    Interval known = oriented(entry(monotone_, 0, lane), least);
    known.lo = std::max({known.lo, by_center, by_face});
    store(monotone_, 0, lane, oriented(known, least));
  });
}

void ClosedFormEvaluator::approx_impact(PointVector impact) noexcept {
  std::fill_n(impact.data(), impact.size() * kLanes, 0.0);
  if (kernel_.determinant_derivatives == nullptr) return;
  compute_derivatives();
  for (std::size_t k = 0; k < splittable_; ++k)
    for_each_lane(slopes_defined_ & lanes_.loaded(), [&](std::size_t lane) {
      impact.at(k, lane) = mag(entry(slopes_, k, lane)) * lanes_.radii().at(k, lane);
    });
}

}  // namespace regulus::detail
