// SPDX-License-Identifier: Apache-2.0
// The matrix over the boxes of a batch, and its products with K.
#include "regulus/search/batch.hpp"

namespace regulus {
namespace {

Interval interval_at(const double* x, std::size_t entry, std::size_t lane) noexcept {
  return {x[lower_at(entry, lane)], x[upper_at(entry, lane)]};
}

void store(double* x, std::size_t entry, std::size_t lane, Interval value) noexcept {
  x[lower_at(entry, lane)] = value.lo;
  x[upper_at(entry, lane)] = value.hi;
}

}  // namespace

void Batch::multiply_left(const double* matrix, double* out) noexcept {
  const double* K = preconditioner();
  for_each_lane(loaded_, [&](std::size_t lane) {
    for (std::size_t i = 0; i < columns_; ++i)
      for (std::size_t j = 0; j < columns_; ++j) {
        Interval sum(0.0);
        for (std::size_t p = 0; p < rows_; ++p)
          sum += Interval(K[point_at(i * rows_ + p, lane)]) *
                 interval_at(matrix, p * columns_ + j, lane);
        store(out, i * columns_ + j, lane, sum);
      }
  });
}

void Batch::multiply_right() noexcept {
  const double* K = preconditioner();
  for_each_lane(loaded_, [&](std::size_t lane) {
    for (std::size_t i = 0; i < rows_; ++i)
      for (std::size_t j = 0; j < rows_; ++j) {
        Interval sum(0.0);
        for (std::size_t p = 0; p < columns_; ++p)
          sum += interval_at(matrix_.get(), i * columns_ + p, lane) *
                 Interval(K[point_at(p * rows_ + j, lane)]);
        store(right_numeric_.get(), i * rows_ + j, lane, sum);
      }
  });
}

LaneMask Batch::left_product_on(const double* boxes, double* out) noexcept {
  if (kernel_.left_product != nullptr)
    return call(kernel_.left_product, boxes, preconditioner(), out);
  const LaneMask defined = call(kernel_.matrix, boxes, nullptr, midpoint_matrix_.get());
  multiply_left(midpoint_matrix_.get(), out);
  return defined;
}

const double* Batch::product(ProductForm form, LaneMask& lanes) noexcept {
  using Side = ProductForm::Side;
  if (form.side != Side::kNone) lanes &= preconditioned();
  if (form.side == Side::kLeft && !form.numeric && kernel_.left_product != nullptr) {
    if (begin(kLeft))
      left_defined_ = call(kernel_.left_product, boxes_.get(), preconditioner(), left_.get());
    lanes &= left_defined_ & loaded_;
    return left_.get();
  }
  if (form.side == Side::kRight && !form.numeric && kernel_.right_product != nullptr) {
    if (begin(kRight))
      right_defined_ = call(kernel_.right_product, boxes_.get(), preconditioner(), right_.get());
    lanes &= right_defined_ & loaded_;
    return right_.get();
  }
  if (begin(kMatrix)) matrix_defined_ = call(kernel_.matrix, boxes_.get(), nullptr, matrix_.get());
  lanes &= matrix_defined_ & loaded_;
  if (form.side == Side::kNone) return matrix_.get();
  if (form.side == Side::kLeft) {
    if (begin(kLeftNumeric)) multiply_left(matrix_.get(), left_numeric_.get());
    return left_numeric_.get();
  }
  if (begin(kRightNumeric)) multiply_right();
  return right_numeric_.get();
}

}  // namespace regulus
