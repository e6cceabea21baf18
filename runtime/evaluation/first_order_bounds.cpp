// SPDX-License-Identifier: Apache-2.0
#include "runtime/evaluation/first_order_bounds.hpp"

#include "runtime/regularity/h_matrix.hpp"

namespace regulus::detail {

FirstOrderBounds::FirstOrderBounds(const BoxLanes& lanes, MidpointEvaluator& midpoint,
                                   ProductEvaluator& product, DerivativeEvaluator& derivatives,
                                   const EvaluationPlan& plan)
    : lanes_(lanes),
      midpoint_(midpoint),
      product_(product),
      derivatives_(derivatives),
      sees_mean_values_(plan.sees_mean_values),
      columns_(lanes.kernel().columns),
      bounds_(columns_ * columns_ * kLanes),
      center_(columns_ * columns_ * kLanes),
      product_at_center_(2 * columns_ * columns_ * kLanes) {}

void FirstOrderBounds::forget() noexcept {
  natural_.forget();
  mean_value_.forget();
}

PointMatrix FirstOrderBounds::P() noexcept {
  return PointMatrix(bounds_.get(), columns_, columns_);
}

ConstPointMatrix FirstOrderBounds::natural() noexcept {
  const PointMatrix bounds = P();
  if (!natural_.begin()) return bounds;
  LaneMask defined = midpoint_.preconditioned();
  distance_to_identity_ru(product_.product({ProductForm::Side::kLeft, false}, defined), bounds);
  for_each_lane(kAllLanes & ~defined, [&](std::size_t lane) {
    for (std::size_t e = 0; e < bounds.size(); ++e) bounds.at(e, lane) = kInfinity;
  });
  return bounds;
}

ConstPointMatrix FirstOrderBounds::mean_value() noexcept {
  static_cast<void>(natural());
  const PointMatrix bounds = P(), center(center_.get(), columns_, columns_);
  if (!sees_mean_values_ || !mean_value_.begin()) return bounds;
  const IntervalMatrix product(product_at_center_.get(), columns_, columns_);
  const ConstIntervalMatrix D = derivatives_.derivatives();
  derivatives_.keep(lanes_.call(lanes_.kernel().left_product, lanes_.thin(),
                                midpoint_.preconditioner().data(), product.data()) &
                    midpoint_.preconditioned());
  distance_to_identity_ru(product, center);
  lower_to_mean_value_ru(center, D, lanes_.radii(), derivatives_.defined(), bounds);
  return bounds;
}

}  // namespace regulus::detail
