// SPDX-License-Identifier: Apache-2.0
// What each variable contributes to the obstacle before a method's test. Heuristics throughout:
// they choose where to split and decide nothing.
//
// Let M be the matrix that the method looks at, N an inverse of its middle. NM is regular where the
// spectral radius of |NM − I| is below 1; with the Perron vectors v and y of that matrix, a change
// by E of M's radii moves it by about yᵀ|N|E v.
#include <algorithm>
#include <cmath>

#include "regulus/regularity/h_matrix.hpp"
#include "regulus/search/batch.hpp"

namespace regulus {
namespace {

/// Where the bounds over a box are not defined, the first derivatives at its middle say what moves
/// K·A most. Where these are not defined either they are [−∞, ∞], and no variable is better than
/// another.
void add_impact_at_center(const regulus_derivatives& first, const double* derivatives,
                          const double* radius, LaneMask lanes, double* impact) noexcept {
  for_each_lane(lanes, [&](std::size_t lane) {
    for (unsigned d = 0; d < first.count; ++d) {
      const std::size_t k = first.list[d].first;
      const double size = std::max(std::fabs(derivatives[lower_at(d, lane)]),
                                   std::fabs(derivatives[upper_at(d, lane)]));
      if (size < kInfinity) impact[point_at(k, lane)] += size * radius[point_at(k, lane)];
    }
  });
}

}  // namespace

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
  }
  clear_impact(kAllLanes & ~derivatives_defined_);
}

/// By how much the entries shrink when one variable is fixed at its midpoint: what a test on
/// enclosures stands to gain, true influence and overestimation alike.
void Batch::impact_from_fixing() noexcept {
  const std::size_t entries = columns_ * columns_;
  LaneMask known = loaded_;
  const double* whole = product(form_, known);
  std::copy_n(boxes_.get(), 2 * variables_ * kLanes, thinned_.get());
  for (std::size_t k = 0; k < splittable_; ++k) {
    double* range = thinned_.get() + lower_at(k, 0);
    std::copy_n(thin_.get() + lower_at(k, 0), 2 * kLanes, range);
    const LaneMask defined = known & product_on(thinned_.get(), preconditioner(), scratch_.get());
    std::copy_n(boxes_.get() + lower_at(k, 0), 2 * kLanes, range);
    for (std::size_t e = 0; e < entries; ++e) {
      double gain[kLanes];
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const double difference = (whole[upper_at(e, lane)] - whole[lower_at(e, lane)]) -
                                  (scratch_[upper_at(e, lane)] - scratch_[lower_at(e, lane)]);
        gain[lane] = has_lane(defined, lane) && difference > 0.0 ? 0.5 * difference : 0.0;
      }
      weigh_impact(k, e / columns_, e % columns_, gain);
    }
  }
}

/// |NM − I| for the method's M; with a neutral 1 where nothing is known.
void Batch::approx_distances(double* P) noexcept {
  const std::size_t n = columns_;
  LaneMask known = preconditioned();
  const double* M = product(form_, known);
  if (form_.side != ProductForm::Side::kNone) {
    distance_to_identity_ru(M, n, P);
  } else {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          double sum = 0.0;
          for (std::size_t p = 0; p < n; ++p)
            sum += std::fabs(preconditioner_[point_at(i * n + p, lane)]) * 0.5 *
                   (M[upper_at(p * n + j, lane)] - M[lower_at(p * n + j, lane)]);
          P[point_at(i * n + j, lane)] = sum;
        }
  }
  for_each_lane(kAllLanes & ~known, [&](std::size_t lane) {
    for (std::size_t e = 0; e < n * n; ++e) P[point_at(e, lane)] = 1.0;
  });
}

/// y ← |N|ᵀy, so that rows of M are weighed instead of rows of NM.
void Batch::weigh_rows() noexcept {
  const std::size_t n = columns_;
  double weight[kMaxColumns * kLanes] = {};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        weight[point_at(p, lane)] +=
            left_perron_[point_at(i, lane)] * std::fabs(preconditioner_[point_at(i * n + p, lane)]);
  std::copy_n(weight, n * kLanes, left_perron_.get());
}

void Batch::compute_perron() noexcept {
  double P[kMaxOrder * kMaxOrder * kLanes];
  if (sees_mean_values_ || second_order_) {
    // A copy, with a neutral 1 where nothing is known: the bounds themselves stay bounds.
    const double* bounds = second_order_ ? second_order_bounds() : natural_bounds();
    for (std::size_t e = 0; e < order() * order() * kLanes; ++e)
      P[e] = bounds[e] < kInfinity ? bounds[e] : 1.0;
  } else {
    approx_distances(P);
  }
  approx_perron(P, order(), right_perron_.get(), left_perron_.get(), approx_spectral_radius_);
}

/// No variable is better than another: the relatively widest is split.
void Batch::clear_impact(LaneMask lanes) noexcept {
  for (std::size_t k = 0; k < variables_; ++k)
    for_each_lane(lanes, [&](std::size_t lane) { impact_[point_at(k, lane)] = 0.0; });
}

double Batch::approx_spectral_radius(std::size_t lane) noexcept {
  if (begin(kPerron)) compute_perron();
  return approx_spectral_radius_[lane];
}

const double* Batch::approx_impact() noexcept {
  if (!begin(kImpact)) return impact_.get();
  if (sees_determinant_) {
    impact_on_determinant();
    return impact_.get();
  }
  if (begin(kPerron)) compute_perron();
  if (second_order_) {
    second_order_->approx_impact(second_order_input(), right_perron_.get(), left_perron_.get(),
                                 impact_.get());
    const LaneMask unknown = kAllLanes & ~second_order_defined_;
    clear_impact(unknown);
    if (unknown != 0)
      add_impact_at_center(kernel_.expansion->first, first_.get(), expanded_radius_.get(),
                           unknown & preconditioned(), impact_.get());
    return impact_.get();
  }
  if (form_.side == ProductForm::Side::kNone) weigh_rows();
  std::fill_n(impact_.get(), variables_ * kLanes, 0.0);
  if (sees_mean_values_ || sharpens_)
    impact_from_derivatives();
  else
    impact_from_fixing();
  return impact_.get();
}

}  // namespace regulus
