// SPDX-License-Identifier: Apache-2.0
// The matrix over the boxes of a batch, and its products with K.
#include <cmath>

#include "regulus/search/batch.hpp"

namespace regulus {
namespace {

using Side = ProductForm::Side;

/// The kernel's function for a product with K; null for A, for numeric products and where the
/// kernel has none.
regulus_function symbolic_product(const regulus_kernel& kernel, ProductForm form) noexcept {
  if (form.side == Side::kNone || form.numeric) return nullptr;
  return form.side == Side::kLeft ? kernel.left_product : kernel.right_product;
}

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

void Batch::multiply_left(const double* matrix, const double* K, double* out) const noexcept {
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

void Batch::multiply_right(const double* matrix, const double* K, double* out) const noexcept {
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

/// The matrix that the method looks at, on any eight boxes and with any K.
LaneMask Batch::product_on(const double* boxes, const double* K, double* out) noexcept {
  if (form_.side == Side::kNone) return call(kernel_.matrix, boxes, nullptr, out);
  if (const regulus_function symbolic = symbolic_product(kernel_, form_))
    return call(symbolic, boxes, K, out);
  const LaneMask defined = call(kernel_.matrix, boxes, nullptr, midpoint_matrix_.get());
  form_.side == Side::kLeft ? multiply_left(midpoint_matrix_.get(), K, out)
                            : multiply_right(midpoint_matrix_.get(), K, out);
  return defined;
}

double* Batch::computed_product(ProductForm form, LaneMask& lanes) noexcept {
  if (form.side != Side::kNone) lanes &= preconditioned();
  const bool left = form.side == Side::kLeft;
  if (const regulus_function symbolic = symbolic_product(kernel_, form)) {
    AlignedBuffer& out = left ? left_ : right_;
    LaneMask& defined = left ? left_defined_ : right_defined_;
    if (begin(left ? kLeft : kRight))
      defined = call(symbolic, boxes_.get(), preconditioner(), out.get());
    lanes &= defined & loaded_;
    return out.get();
  }
  if (begin(kMatrix)) matrix_defined_ = call(kernel_.matrix, boxes_.get(), nullptr, matrix_.get());
  lanes &= matrix_defined_ & loaded_;
  if (form.side == Side::kNone) return matrix_.get();
  if (left) {
    if (begin(kLeftNumeric)) multiply_left(matrix_.get(), preconditioner(), left_numeric_.get());
    return left_numeric_.get();
  }
  if (begin(kRightNumeric)) multiply_right(matrix_.get(), preconditioner(), right_numeric_.get());
  return right_numeric_.get();
}

const double* Batch::product(ProductForm form, LaneMask& lanes) noexcept {
  double* entries = computed_product(form, lanes);
  if (sharpens_ && form == form_ && begin(kSharpened)) sharpen(entries, lanes);
  return entries;
}

}  // namespace regulus
