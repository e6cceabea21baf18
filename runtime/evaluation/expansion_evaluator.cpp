// SPDX-License-Identifier: Apache-2.0
#include "runtime/evaluation/expansion_evaluator.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail {
namespace {

std::vector<DerivativePlace> places(const regulus_derivatives& derivatives) {
  std::vector<DerivativePlace> list;
  for (unsigned i = 0; i < derivatives.count; ++i) {
    const regulus_derivative& d = derivatives.list[i];
    list.push_back({d.row, d.column, d.first, d.second});
  }
  return list;
}

DerivativeLists listed_derivatives(const regulus_kernel& kernel) {
  const regulus_expansion& x = *kernel.expansion;
  return {kernel.rows,      kernel.columns,      kernel.variables,    places(x.first),
          places(x.second), places(x.row_first), places(x.row_second)};
}

AlignedBuffer room_for(const regulus_derivatives& derivatives) {
  return AlignedBuffer(2 * kLanes * derivatives.count);
}

}  // namespace

ExpansionEvaluator::ExpansionEvaluator(const BoxLanes& lanes, MidpointEvaluator& midpoint,
                                       ProductEvaluator& product, const RowStructure& structure,
                                       const EvaluationPlan& plan, bool for_easy_boxes)
    : lanes_(lanes),
      midpoint_(midpoint),
      product_(product),
      kernel_(lanes.kernel()),
      expansion_(*kernel_.expansion),
      structure_(structure),
      second_order_(listed_derivatives(kernel_), structure,
                    SecondOrderOptions{
                        .moving = plan.moves_preconditioner ? SecondOrderOptions::kAllVariables : 0,
                        .weighs_row_variables = plan.weighs_row_variables}),
      point_(2 * lanes.variables() * kLanes),
      radius_(lanes.variables() * kLanes),
      center_product_(2 * std::size_t{kernel_.columns} * kernel_.columns * kLanes),
      first_(room_for(expansion_.first)),
      second_(room_for(expansion_.second)),
      row_first_(room_for(expansion_.row_first)),
      row_second_(room_for(expansion_.row_second)),
      bounds_(order() * order() * kLanes) {
  const SecondOrderOptions options{.moving = kernel_.motion_variables, .keeps_shares = false};
  if (!for_easy_boxes) return;
  along_motion_.emplace(listed_derivatives(kernel_), structure, options);
  motion_bounds_ = AlignedBuffer(order() * order() * kLanes);
}

/// Loads the point of expansion, and the distances from it to the ends of the box.
void ExpansionEvaluator::load_expansion_point() noexcept {
  const std::size_t count = point_known_ ? lanes_.changing() : lanes_.variables();
  point_known_ = true;
  std::copy_n(lanes_.thin().data(), 2 * count * kLanes, point_.get());
  std::copy_n(lanes_.radii().data(), count * kLanes, radius_.get());
  const double* nominal = expansion_.nominal;
  if (nominal == nullptr) return;
  for (std::size_t k = 0; k < count; ++k) {
    if (!structure_.touches_one_row(k)) continue;
    const double lo = nominal[2 * k], hi = nominal[2 * k + 1];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      point_[lower_at(k, lane)] = lo;
      point_[upper_at(k, lane)] = hi;
      const Interval x = lanes_.box(k, lane);
      radius_[point_at(k, lane)] = std::max(sub_ru(x.hi, lo), sub_ru(hi, x.lo));
    }
  }
  if (count == lanes_.variables())
    point_outside_contract_ = lanes_outside_contract(point_.get(), static_cast<unsigned>(count));
}

LaneMask ExpansionEvaluator::call_listed(const regulus_derivatives& derivatives,
                                         ConstIntervalVector boxes, AlignedBuffer& out) noexcept {
  if (derivatives.function == nullptr) return kAllLanes;
  return lanes_.call(derivatives.function, boxes, midpoint_.preconditioner().data(), out.get());
}

SecondOrderInput ExpansionEvaluator::input() noexcept {
  return {.K = midpoint_.preconditioner(),
          .product = ConstIntervalMatrix(center_product_.get(), kernel_.columns, kernel_.columns),
          .first = ConstIntervalVector(first_.get(), expansion_.first.count),
          .second = ConstIntervalVector(second_.get(), expansion_.second.count),
          .row_first = ConstIntervalVector(row_first_.get(), expansion_.row_first.count),
          .row_second = ConstIntervalVector(row_second_.get(), expansion_.row_second.count),
          .radius = ConstPointVector(radius_.get(), lanes_.variables())};
}

/// Calls the functions of the kernel that the bounds use.
void ExpansionEvaluator::call_kernel() noexcept {
  if (!called_.begin()) return;
  load_expansion_point();
  const ConstIntervalVector point(point_.get(), lanes_.variables());
  LaneMask defined = midpoint_.preconditioned() & ~point_outside_contract_;
  defined &= lanes_.call(expansion_.product, point, midpoint_.preconditioner().data(),
                         center_product_.get());
  defined &= call_listed(expansion_.first, point, first_);
  defined &= call_listed(expansion_.row_first, point, row_first_);
  defined &= call_listed(expansion_.second, lanes_.boxes(), second_);
  defined &= call_listed(expansion_.row_second, lanes_.boxes(), row_second_);
  // Any function of the kernel reports where A is not defined.
  if (expansion_.second.function == nullptr && expansion_.row_second.function == nullptr)
    static_cast<void>(product_.product({}, defined));
  defined_ = defined;
}

void ExpansionEvaluator::compute(SecondOrderBounds& second_order, PointMatrix T) noexcept {
  call_kernel();
  second_order.bound_ru(input(), T);
  for_each_lane(kAllLanes & ~defined_, [&](std::size_t lane) {
    for (std::size_t e = 0; e < T.size(); ++e) T.at(e, lane) = kInfinity;
  });
}

ConstPointMatrix ExpansionEvaluator::bounds() noexcept {
  const PointMatrix T(bounds_.get(), order(), order());
  if (computed_.begin()) compute(second_order_, T);
  return T;
}

ConstPointMatrix ExpansionEvaluator::motion_bounds() noexcept {
  const PointMatrix T(motion_bounds_.get(), order(), order());
  if (computed_along_motion_.begin()) compute(*along_motion_, T);
  return T;
}

LaneMask ExpansionEvaluator::defined() noexcept {
  call_kernel();
  return defined_;
}

LaneNumbers ExpansionEvaluator::moving_determinant_ru() noexcept {
  static_cast<void>(bounds());
  return second_order_.moving_determinant_ru(input());
}

LaneMask ExpansionEvaluator::certain_by_orthants(ConstPointVector guess, LaneMask lanes,
                                                 unsigned halvings) noexcept {
  const ConstPointMatrix T = bounds();
  return second_order_.certain_by_orthants(input(), T, guess, lanes, halvings, orthant_hint_);
}

/// If the bounds over a box are not defined, uses the first derivatives at its middle: they show
/// which variables move K·A most. If these are not defined either, they are [−∞, ∞], and no
/// variable is better than another.
void ExpansionEvaluator::add_impact_at_center(LaneMask lanes, PointVector impact) const noexcept {
  for_each_lane(lanes, [&](std::size_t lane) {
    for (unsigned d = 0; d < expansion_.first.count; ++d) {
      const std::size_t k = expansion_.first.list[d].first;
      const double size =
          std::max(std::fabs(first_[lower_at(d, lane)]), std::fabs(first_[upper_at(d, lane)]));
      if (size < kInfinity) impact.at(k, lane) += size * radius_[point_at(k, lane)];
    }
  });
}

void ExpansionEvaluator::approx_impact(PerronVectors vectors, PointVector impact) noexcept {
  const LaneMask unknown = kAllLanes & ~defined();
  second_order_.approx_impact(input(), vectors, impact);
  for_each_lane(unknown, [&](std::size_t lane) {
    for (std::size_t k = 0; k < impact.rows(); ++k) impact.at(k, lane) = 0.0;
  });
  if (unknown != 0) add_impact_at_center(unknown & midpoint_.preconditioned(), impact);
}

}  // namespace regulus::detail
