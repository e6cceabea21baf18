// SPDX-License-Identifier: Apache-2.0
#include "runtime/evaluation/midpoint_evaluator.hpp"

#include <cmath>

#include "runtime/regularity/backend.hpp"
#include "runtime/regularity/determinant.hpp"
#include "runtime/regularity/midpoint_inverse.hpp"

namespace regulus::detail {

MidpointEvaluator::MidpointEvaluator(const BoxLanes& lanes)
    : lanes_(lanes),
      rows_(lanes.kernel().rows),
      columns_(lanes.kernel().columns),
      matrix_(2 * rows_ * columns_ * kLanes),
      approx_matrix_(rows_ * columns_ * kLanes),
      preconditioner_(rows_ * columns_ * kLanes) {}

void MidpointEvaluator::compute() noexcept {
  defined_ = lanes_.call(lanes_.kernel().matrix, lanes_.thin(), nullptr, matrix_.get());
  const RegularityBackend& backend = regularity_backend();
  const PointMatrix A(approx_matrix_.get(), rows_, columns_);
  backend.take_middles(ConstIntervalMatrix(matrix_.get(), rows_, columns_), A);
  const PointMatrix K(preconditioner_.get(), columns_, rows_);
  const LaneMask failed = approx_inverse(A, K, approx_determinant_);
  preconditioned_ = defined_ & ~failed & backend.within(K, kMaxPointMagnitude);
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

}  // namespace regulus::detail
