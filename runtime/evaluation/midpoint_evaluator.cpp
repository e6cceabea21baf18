// SPDX-License-Identifier: Apache-2.0
#include "runtime/evaluation/midpoint_evaluator.hpp"

#include <cmath>
#include <cstdint>

#include "runtime/regularity/determinant.hpp"
#include "runtime/regularity/midpoint_inverse.hpp"

namespace regulus {
namespace {

/// Returns the lanes in which no entry exceeds the limit or is NaN.
LaneMask lanes_within(ConstPointMatrix x, double limit) noexcept {
  std::int64_t beyond[kLanes] = {};
  for (std::size_t e = 0; e < x.size(); ++e)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      beyond[lane] |= -std::int64_t{!(std::fabs(x.at(e, lane)) <= limit)};
  LaneMask within = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    if (beyond[lane] == 0) within |= 1U << lane;
  return within;
}

}  // namespace

MidpointEvaluator::MidpointEvaluator(const BoxLanes& lanes)
    : lanes_(lanes),
      rows_(lanes.kernel().rows),
      columns_(lanes.kernel().columns),
      matrix_(2 * rows_ * columns_ * kLanes),
      approx_matrix_(rows_ * columns_ * kLanes),
      preconditioner_(rows_ * columns_ * kLanes) {}

void MidpointEvaluator::compute() noexcept {
  defined_ = lanes_.call(lanes_.kernel().matrix, lanes_.thin(), nullptr, matrix_.get());
  for (std::size_t e = 0; e < rows_ * columns_; ++e)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      approx_matrix_[point_at(e, lane)] =
          0.5 * matrix_[lower_at(e, lane)] + 0.5 * matrix_[upper_at(e, lane)];
  const PointMatrix K(preconditioner_.get(), columns_, rows_);
  const LaneMask failed = approx_inverse(ConstPointMatrix(approx_matrix_.get(), rows_, columns_), K,
                                         approx_determinant_);
  preconditioned_ = defined_ & ~failed & lanes_within(K, kMaxPointMagnitude);
  for_each_lane(kAllLanes & ~preconditioned_, [&K](std::size_t lane) {
    for (std::size_t e = 0; e < K.size(); ++e) K.at(e, lane) = 0.0;
  });
}

LaneMask MidpointEvaluator::defined() noexcept {
  if (computed_.begin()) compute();
  return defined_ & lanes_.loaded();
}

LaneMask MidpointEvaluator::preconditioned() noexcept {
  if (computed_.begin()) compute();
  return preconditioned_ & lanes_.loaded();
}

ConstPointMatrix MidpointEvaluator::preconditioner() noexcept {
  if (computed_.begin()) compute();
  return ConstPointMatrix(preconditioner_.get(), columns_, rows_);
}

/// A heuristic: it uses plain doubles and the midpoint alone.
LaneMask MidpointEvaluator::poorly_preconditioned() noexcept {
  constexpr double kPoor = 0.25;
  LaneMask good = preconditioned();
  if (good == 0) return lanes_.loaded();
  for (std::size_t i = 0; i < columns_; ++i)
    for (std::size_t j = 0; j < columns_; ++j)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        double sum = i == j ? -1.0 : 0.0;
        for (std::size_t p = 0; p < rows_; ++p)
          sum += preconditioner_[point_at(i * rows_ + p, lane)] *
                 approx_matrix_[point_at(p * columns_ + j, lane)];
        if (!(std::fabs(sum) < kPoor)) good &= ~(1U << lane);
      }
  return lanes_.loaded() & ~good;
}

double MidpointEvaluator::approx_determinant(std::size_t lane) noexcept {
  if (computed_.begin()) compute();
  return approx_determinant_[lane];
}

Interval MidpointEvaluator::preconditioner_determinant(std::size_t lane) noexcept {
  return enclose_determinant_by_elimination(matrix_of_lane(preconditioner(), lane));
}

}  // namespace regulus
