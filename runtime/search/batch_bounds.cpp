// SPDX-License-Identifier: Apache-2.0
// Bounds of |KA − I| over the boxes of a batch, and what each variable contributes to them.
#include <algorithm>
#include <cmath>
#include <limits>

#include "regulus/regularity/h_matrix.hpp"
#include "regulus/search/batch.hpp"

namespace regulus {
namespace {

void fill_lane(double* x, std::size_t entries, std::size_t lane, double value) noexcept {
  for (std::size_t e = 0; e < entries; ++e) x[point_at(e, lane)] = value;
}

}  // namespace

double* Batch::natural_bounds() noexcept {
  if (!begin(kNatural)) return bounds_.get();
  LaneMask defined = preconditioned();
  const double* entries = left_.get();
  if (is_structured())
    defined &= left_product_on(nominal_.get(), left_.get());
  else
    entries = product({ProductForm::Side::kLeft, false}, defined);
  distance_to_identity_ru(entries, columns_, bounds_.get());
  for_each_lane(kEveryLane & ~defined, [this](std::size_t lane) {
    fill_lane(bounds_.get(), columns_ * columns_, lane, kInfinity);
  });
  return bounds_.get();
}

void Batch::compute_derivatives() noexcept {
  if (!begin(kDerivatives)) return;
  derivatives_defined_ =
      call(kernel_.left_derivatives, nominal_.get(), preconditioner(), derivatives_.get()) &
      preconditioned();
}

double* Batch::mean_value_bounds() noexcept {
  double* bounds = natural_bounds();
  if (!sees_mean_values_ || !begin(kMeanValue)) return bounds;
  compute_derivatives();
  const LaneMask center_defined =
      call(kernel_.left_product, thin_.get(), preconditioner(), scratch_.get());
  distance_to_identity_ru(scratch_.get(), columns_, center_.get());
  derivatives_defined_ &= center_defined;
  lower_to_mean_value_ru(center_.get(), derivatives_.get(), wide_radius_.get(), columns_,
                         variables_, derivatives_defined_, bounds);
  return bounds;
}

StructuredInput Batch::structured_input() noexcept {
  return {rows_,
          columns_,
          variables_,
          bounds_.get(),
          center_.get(),
          preconditioner_.get(),
          derivatives_.get(),
          derivatives_defined_,
          full_derivatives_.get(),
          radius_.get(),
          slopes_.get()};
}

double* Batch::structured_bounds() noexcept {
  static_cast<void>(mean_value_bounds());
  if (!begin(kStructured)) return structured_.get();
  LaneMask defined =
      call(kernel_.left_derivatives, boxes_.get(), preconditioner(), full_derivatives_.get()) &
      preconditioned();
  // The matrix, too, must be defined for all uncertain values.
  static_cast<void>(product({}, defined));
  structured_bounds_ru(structure_, structured_input(), structured_.get());
  for_each_lane(kEveryLane & ~defined, [this](std::size_t lane) {
    fill_lane(structured_.get(), order() * order(), lane, kInfinity);
  });
  return structured_.get();
}

void Batch::weigh_impact(std::size_t variable, std::size_t row, std::size_t column,
                         const double* magnitude) noexcept {
  const double* v = right_perron_.get() + column * kLanes;
  const double* y = left_perron_.get() + row * kLanes;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    impact_[point_at(variable, lane)] += y[lane] * magnitude[lane] * v[lane];
}

void Batch::impact_from_derivatives() noexcept {
  compute_derivatives();
  const std::size_t entries = columns_ * columns_;
  for (std::size_t k = 0; k < splittable_; ++k) {
    for (std::size_t e = 0; e < entries; ++e) {
      double magnitude[kLanes];
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        magnitude[lane] = std::max(std::fabs(derivatives_[lower_at(k * entries + e, lane)]),
                                   std::fabs(derivatives_[upper_at(k * entries + e, lane)])) *
                          radius_[point_at(k, lane)];
      weigh_impact(k, e / columns_, e % columns_, magnitude);
    }
    for_each_lane(kEveryLane & ~derivatives_defined_,
                  [&](std::size_t lane) { impact_[point_at(k, lane)] = 0.0; });
  }
}

/// By how much the bounds shrink when one variable is fixed at its midpoint: what a test on natural
/// entries stands to gain, true influence and overestimation alike.
void Batch::impact_from_fixing() noexcept {
  const std::size_t entries = columns_ * columns_;
  std::copy_n(boxes_.get(), 2 * variables_ * kLanes, thinned_.get());
  for (std::size_t k = 0; k < splittable_; ++k) {
    double* range = thinned_.get() + lower_at(k, 0);
    std::copy_n(thin_.get() + lower_at(k, 0), 2 * kLanes, range);
    const LaneMask defined = left_product_on(thinned_.get(), scratch_.get());
    std::copy_n(boxes_.get() + lower_at(k, 0), 2 * kLanes, range);
    distance_to_identity_ru(scratch_.get(), columns_, center_.get());
    for (std::size_t e = 0; e < entries; ++e) {
      double gain[kLanes];
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const double difference = bounds_[point_at(e, lane)] - center_[point_at(e, lane)];
        gain[lane] = has_lane(defined, lane) && difference > 0.0 ? difference : 0.0;
      }
      weigh_impact(k, e / columns_, e % columns_, gain);
    }
  }
}

const double* Batch::approx_impact() noexcept {
  if (!begin(kImpact)) return impact_.get();
  if (sees_determinant_) {
    impact_on_determinant();
    return impact_.get();
  }
  // A copy, with a neutral matrix where nothing is known: the bounds themselves stay bounds.
  double P[kMaxOrder * kMaxOrder * kLanes];
  double approx_radius[kLanes];
  const std::size_t n = order();
  const double* bounds = is_structured() ? structured_bounds() : natural_bounds();
  for (std::size_t e = 0; e < n * n * kLanes; ++e) P[e] = bounds[e] < kInfinity ? bounds[e] : 1.0;
  approx_perron(P, n, right_perron_.get(), left_perron_.get(), approx_radius);
  std::fill_n(impact_.get(), variables_ * kLanes, 0.0);
  if (sees_mean_values_)
    impact_from_derivatives();
  else
    impact_from_fixing();
  return impact_.get();
}

}  // namespace regulus
