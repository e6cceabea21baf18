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
  LaneMask defined = kEveryLane;
  const double* product_bounds = product({ProductForm::Side::kLeft, false}, defined);
  distance_to_identity_ru(product_bounds, columns_, bounds_.get());
  for_each_lane(kEveryLane & ~defined, [this](std::size_t lane) {
    fill_lane(bounds_.get(), columns_ * columns_, lane, kInfinity);
  });
  return bounds_.get();
}

void Batch::compute_derivatives() noexcept {
  if (!begin(kDerivatives)) return;
  derivatives_defined_ =
      call(kernel_.left_derivatives, boxes_.get(), preconditioner(), derivatives_.get()) &
      preconditioned();
}

double* Batch::mean_value_bounds() noexcept {
  double* bounds = natural_bounds();
  if (!has_derivatives() || kernel_.left_product == nullptr || !begin(kMeanValue)) return bounds;
  compute_derivatives();
  const LaneMask center_defined =
      call(kernel_.left_product, thin_.get(), preconditioner(), scratch_.get());
  distance_to_identity_ru(scratch_.get(), columns_, center_.get());
  lower_to_mean_value_ru(center_.get(), derivatives_.get(), radius_.get(), columns_, variables_,
                         derivatives_defined_ & center_defined, bounds);
  return bounds;
}

void Batch::weigh_impact(std::size_t variable, std::size_t entry,
                         const double* magnitude) noexcept {
  const double* v = right_perron_.get() + (entry % columns_) * kLanes;
  const double* y = left_perron_.get() + (entry / columns_) * kLanes;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    impact_[point_at(variable, lane)] += y[lane] * magnitude[lane] * v[lane];
}

void Batch::impact_from_derivatives() noexcept {
  compute_derivatives();
  const std::size_t entries = columns_ * columns_;
  for (std::size_t k = 0; k < variables_; ++k) {
    for (std::size_t e = 0; e < entries; ++e) {
      double magnitude[kLanes];
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        magnitude[lane] = std::max(std::fabs(derivatives_[lower_at(k * entries + e, lane)]),
                                   std::fabs(derivatives_[upper_at(k * entries + e, lane)])) *
                          radius_[point_at(k, lane)];
      weigh_impact(k, e, magnitude);
    }
    for_each_lane(kEveryLane & ~derivatives_defined_,
                  [&](std::size_t lane) { impact_[point_at(k, lane)] = 0.0; });
  }
}

/// magnitude[e] ≈ |K·(A(t₀ + r_k e_k) − A(t₀ − r_k e_k))|/2, in point layout.
void Batch::add_difference(std::size_t variable, double* magnitude) noexcept {
  const std::size_t entries = rows_ * columns_;
  LaneMask defined = kEveryLane;
  std::fill_n(approx_matrix_.get(), entries * kLanes, 0.0);
  for (const double sign : {-0.5, 0.5}) {
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      thin_[lower_at(variable, lane)] = thin_[upper_at(variable, lane)] =
          boxes_[sign < 0 ? lower_at(variable, lane) : upper_at(variable, lane)];
    defined &= call(kernel_.matrix, thin_.get(), nullptr, scratch_.get());
    for (std::size_t e = 0; e < entries; ++e)
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        approx_matrix_[point_at(e, lane)] +=
            sign * 0.5 * (scratch_[lower_at(e, lane)] + scratch_[upper_at(e, lane)]);
  }
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    thin_[lower_at(variable, lane)] = thin_[upper_at(variable, lane)] =
        midpoint_[point_at(variable, lane)];
  for (std::size_t i = 0; i < columns_; ++i)
    for (std::size_t j = 0; j < columns_; ++j)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        double sum = 0.0;
        for (std::size_t p = 0; p < rows_; ++p)
          sum += preconditioner_[point_at(i * rows_ + p, lane)] *
                 approx_matrix_[point_at(p * columns_ + j, lane)];
        magnitude[point_at(i * columns_ + j, lane)] = has_lane(defined, lane) ? std::fabs(sum) : 0;
      }
}

void Batch::impact_from_differences() noexcept {
  static_cast<void>(preconditioned());  // approx_matrix_ is free from here on
  for (std::size_t k = 0; k < variables_; ++k) {
    add_difference(k, center_.get());
    for (std::size_t e = 0; e < columns_ * columns_; ++e)
      weigh_impact(k, e, center_.get() + e * kLanes);
  }
}

const double* Batch::approx_impact() noexcept {
  if (!begin(kImpact)) return impact_.get();
  // A copy, with a neutral matrix where nothing is known: the bounds themselves stay bounds.
  double P[kMaxColumns * kMaxColumns * kLanes];
  double approx_radius[kLanes];
  const double* bounds = natural_bounds();
  for (std::size_t e = 0; e < columns_ * columns_ * kLanes; ++e)
    P[e] = bounds[e] < kInfinity ? bounds[e] : 1.0;
  approx_perron(P, columns_, right_perron_.get(), left_perron_.get(), approx_radius);
  std::fill_n(impact_.get(), variables_ * kLanes, 0.0);
  if (has_derivatives())
    impact_from_derivatives();
  else
    impact_from_differences();
  return impact_.get();
}

}  // namespace regulus
