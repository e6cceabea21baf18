// SPDX-License-Identifier: Apache-2.0
// The matrix over the boxes of a batch, and its products with K.
#include <cmath>

#include "regulus/search/batch.hpp"

namespace regulus {
namespace {

/// Σ kₚ·mₚ for eight lanes of points kₚ and intervals mₚ, bounded outward at the end.
///
/// Rounding  The bound of a product is one of k·lo and k·hi, rounded; with t terms and u = 2^-52
///           (any mode) the sums are off by at most ((1+u)^(t+1) − 1)·Σ|k|·mag m + t·2^-1074, and
///           the last addition by u times its result: together below 2(t+4)u·Σ|k|·mag m + 2^-1000.
class ProductSum {
 public:
  void add(const double* k, const double* lo, const double* hi) noexcept {
    ++terms_;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double a = k[lane] * lo[lane];
      const double b = k[lane] * hi[lane];
      lower_[lane] += a < b ? a : b;
      upper_[lane] += a < b ? b : a;
      const double p = std::fabs(a);
      const double q = std::fabs(b);
      magnitude_[lane] += p < q ? q : p;
    }
  }
  void store(double* lo, double* hi) const noexcept {
    const double unit = static_cast<double>(terms_ + 4) * 0x1p-51;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double error = raise_ru(magnitude_[lane] * unit, raise_factor(terms_ + 1));
      lo[lane] = lower_[lane] - error;
      hi[lane] = upper_[lane] + error;
    }
  }

 private:
  std::size_t terms_ = 0;
  double lower_[kLanes] = {};
  double upper_[kLanes] = {};
  double magnitude_[kLanes] = {};
};

}  // namespace

void Batch::multiply_left(const double* matrix, double* out) noexcept {
  const double* K = preconditioner();
  for (std::size_t i = 0; i < columns_; ++i)
    for (std::size_t j = 0; j < columns_; ++j) {
      ProductSum sum;
      for (std::size_t p = 0; p < rows_; ++p) {
        const std::size_t e = p * columns_ + j;
        sum.add(K + point_at(i * rows_ + p, 0), matrix + lower_at(e, 0), matrix + upper_at(e, 0));
      }
      const std::size_t e = i * columns_ + j;
      sum.store(out + lower_at(e, 0), out + upper_at(e, 0));
    }
}

void Batch::multiply_right(const double* matrix, double* out) noexcept {
  const double* K = preconditioner();
  for (std::size_t i = 0; i < rows_; ++i)
    for (std::size_t j = 0; j < rows_; ++j) {
      ProductSum sum;
      for (std::size_t p = 0; p < columns_; ++p) {
        const std::size_t e = i * columns_ + p;
        sum.add(K + point_at(p * rows_ + j, 0), matrix + lower_at(e, 0), matrix + upper_at(e, 0));
      }
      const std::size_t e = i * rows_ + j;
      sum.store(out + lower_at(e, 0), out + upper_at(e, 0));
    }
}

LaneMask Batch::left_product_on(const double* boxes, double* out) noexcept {
  return product_on({ProductForm::Side::kLeft, false}, boxes, out);
}

/// As product(), on any eight boxes with the K of this batch.
LaneMask Batch::product_on(ProductForm form, const double* boxes, double* out) noexcept {
  using Side = ProductForm::Side;
  if (form.side == Side::kNone) return call(kernel_.matrix, boxes, nullptr, out);
  const regulus_function symbolic =
      form.side == Side::kLeft ? kernel_.left_product : kernel_.right_product;
  if (!form.numeric && symbolic != nullptr) return call(symbolic, boxes, preconditioner(), out);
  const LaneMask defined = call(kernel_.matrix, boxes, nullptr, midpoint_matrix_.get());
  if (form.side == Side::kLeft)
    multiply_left(midpoint_matrix_.get(), out);
  else
    multiply_right(midpoint_matrix_.get(), out);
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
  if (begin(kRightNumeric)) multiply_right(matrix_.get(), right_numeric_.get());
  return right_numeric_.get();
}

}  // namespace regulus
