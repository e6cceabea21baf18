// SPDX-License-Identifier: Apache-2.0
// Let M be the matrix that the method uses, and N an inverse of its middle. NM is regular if the
// spectral radius of |NM − I| is below 1. Let v and y be the Perron vectors of that matrix. Then a
// change by E of M's radii moves the spectral radius by about yᵀ|N|E v.
#include "runtime/evaluation/impact_evaluator.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/regularity/h_matrix.hpp"

namespace regulus::detail {

ImpactEvaluator::ImpactEvaluator(const Sources& sources, const EvaluationPlan& plan,
                                 std::size_t order)
    : from_(sources),
      plan_(plan),
      order_(order),
      columns_(sources.lanes.kernel().columns),
      variables_(sources.lanes.variables()),
      right_(order * kLanes),
      left_(order * kLanes),
      impact_(variables_ * kLanes),
      fixed_boxes_(2 * variables_ * kLanes),
      fixed_product_(2 * std::max(columns_, std::size_t{sources.lanes.kernel().rows}) *
                     std::max(columns_, std::size_t{sources.lanes.kernel().rows}) * kLanes) {}

void ImpactEvaluator::forget() noexcept {
  perron_known_.forget();
  impact_known_.forget();
}

PerronVectors ImpactEvaluator::vectors() noexcept {
  return {.right = PointVector(right_.get(), order_), .left = PointVector(left_.get(), order_)};
}

PointVector ImpactEvaluator::impact() noexcept { return PointVector(impact_.get(), variables_); }

/// Computes |NM − I| for the method's M; uses a neutral 1 if nothing is known.
void ImpactEvaluator::approx_distances(PointMatrix P) noexcept {
  const std::size_t n = columns_;
  LaneMask known = from_.midpoint.preconditioned();
  const ConstIntervalMatrix M = from_.product.product(plan_.form, known);
  const ConstPointMatrix K = from_.midpoint.preconditioner();
  if (plan_.form.side != ProductForm::Side::kNone) {
    distance_to_identity_ru(M, P);
  } else {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          double sum = 0.0;
          for (std::size_t p = 0; p < n; ++p)
            sum += std::fabs(K.at(i * n + p, lane)) * 0.5 *
                   (M.upper(p * n + j, lane) - M.lower(p * n + j, lane));
          P.at(i * n + j, lane) = sum;
        }
  }
  for_each_lane(kAllLanes & ~known, [&](std::size_t lane) {
    for (std::size_t e = 0; e < P.size(); ++e) P.at(e, lane) = 1.0;
  });
}

/// Works on a copy, with a neutral 1 if nothing is known: the bounds themselves must not change.
LaneNumbers ImpactEvaluator::perron_of(ConstPointMatrix bounds) noexcept {
  double P[kMaxOrder * kMaxOrder * kLanes];
  for (std::size_t i = 0; i < bounds.size() * kLanes; ++i)
    P[i] = bounds.data()[i] < kInfinity ? bounds.data()[i] : 1.0;
  return approx_perron(ConstPointMatrix(P, order_, order_), vectors());
}

void ImpactEvaluator::find_perron() noexcept {
  if (!perron_known_.begin()) return;
  if (from_.expansion) {
    approx_spectral_radius_ = perron_of(from_.expansion->bounds());
  } else if (plan_.sees_mean_values) {
    approx_spectral_radius_ = perron_of(from_.first_order.natural());
  } else {
    double numbers[kMaxColumns * kMaxColumns * kLanes];
    const PointMatrix P(numbers, columns_, columns_);
    approx_distances(P);
    approx_spectral_radius_ = approx_perron(P, vectors());
  }
}

double ImpactEvaluator::approx_spectral_radius(std::size_t lane) noexcept {
  find_perron();
  return approx_spectral_radius_[lane];
}

ConstPointVector ImpactEvaluator::approx_right_vector() noexcept {
  find_perron();
  return vectors().right;
}

/// Weighs entry row·n + column of M.
void ImpactEvaluator::weigh(std::size_t variable, std::size_t entry,
                            const double* magnitude) noexcept {
  const double* v = right_.get() + point_at(entry % columns_, 0);
  const double* y = left_.get() + point_at(entry / columns_, 0);
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    impact_[point_at(variable, lane)] += y[lane] * magnitude[lane] * v[lane];
}

/// Replaces y by |N|ᵀy, so that rows of M are weighed instead of rows of NM.
void ImpactEvaluator::weigh_rows() noexcept {
  const std::size_t n = columns_;
  const ConstPointMatrix K = from_.midpoint.preconditioner();
  double weight[kMaxColumns * kLanes] = {};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        weight[point_at(p, lane)] += left_[point_at(i, lane)] * std::fabs(K.at(i * n + p, lane));
  std::copy_n(weight, n * kLanes, left_.get());
}

void ImpactEvaluator::from_derivatives() noexcept {
  const ConstIntervalMatrix D = from_.derivatives.derivatives();
  const std::size_t entries = columns_ * columns_;
  for (std::size_t k = 0; k < plan_.splittable; ++k)
    for (std::size_t e = 0; e < entries; ++e) {
      double magnitude[kLanes];
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        magnitude[lane] = std::max(std::fabs(D.lower(k * entries + e, lane)),
                                   std::fabs(D.upper(k * entries + e, lane))) *
                          from_.lanes.radii().at(k, lane);
      weigh(k, e, magnitude);
    }
  // No variable is better than another, so the relatively widest one is split.
  for_each_lane(kAllLanes & ~from_.derivatives.defined(), [this](std::size_t lane) {
    for (std::size_t k = 0; k < variables_; ++k) impact_[point_at(k, lane)] = 0.0;
  });
}

/// Computes how much the entries shrink if one variable is fixed at its midpoint. A test on
/// enclosures could gain this much; it includes both true influence and overestimation.
void ImpactEvaluator::from_fixing() noexcept {
  const BoxLanes& lanes = from_.lanes;
  LaneMask known = lanes.loaded();
  const ConstIntervalMatrix whole = from_.product.product(plan_.form, known);
  const IntervalMatrix fixed(fixed_product_.get(), whole.rows(), whole.columns());
  const ConstIntervalVector boxes(fixed_boxes_.get(), variables_);
  const double* wide = lanes.boxes().data();
  std::copy_n(wide, 2 * variables_ * kLanes, fixed_boxes_.get());
  for (std::size_t k = 0; k < plan_.splittable; ++k) {
    double* range = fixed_boxes_.get() + lower_at(k, 0);
    std::copy_n(lanes.thin().data() + lower_at(k, 0), 2 * kLanes, range);
    const LaneMask defined =
        known & from_.matrix.evaluate(boxes, from_.midpoint.preconditioner(), fixed);
    std::copy_n(wide + lower_at(k, 0), 2 * kLanes, range);
    for (std::size_t e = 0; e < columns_ * columns_; ++e) {
      double gain[kLanes];
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const double difference = (whole.upper(e, lane) - whole.lower(e, lane)) -
                                  (fixed.upper(e, lane) - fixed.lower(e, lane));
        gain[lane] = has_lane(defined, lane) && difference > 0.0 ? 0.5 * difference : 0.0;
      }
      weigh(k, e, gain);
    }
  }
}

void ImpactEvaluator::estimate() noexcept {
  if (plan_.sees_determinant) return from_.closed_form.approx_impact(impact());
  find_perron();
  if (from_.expansion) return from_.expansion->approx_impact(vectors(), impact());
  if (plan_.form.side == ProductForm::Side::kNone) weigh_rows();
  std::fill_n(impact_.get(), variables_ * kLanes, 0.0);
  plan_.sees_mean_values || plan_.sharpens ? from_derivatives() : from_fixing();
}

ConstPointVector ImpactEvaluator::approx_impact() noexcept {
  if (impact_known_.begin()) estimate();
  return impact();
}

}  // namespace regulus::detail
