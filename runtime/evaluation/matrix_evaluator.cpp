// SPDX-License-Identifier: Apache-2.0
#include "runtime/evaluation/matrix_evaluator.hpp"

#include <cmath>

#include "runtime/regularity/lanes.hpp"

namespace regulus::detail {
namespace {

using Side = ProductForm::Side;

/// Sums kₚ·mₚ for eight lanes of points kₚ and intervals mₚ; rounds outward at the end.
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

/// Entry (i, j) of the product is the sum over p < terms of entry_of_K(i, j, p)·entry_of_A(i, j,
/// p).
template <typename EntryOfK, typename EntryOfA>
void multiply(ConstIntervalMatrix A, ConstPointMatrix K, IntervalMatrix product, std::size_t terms,
              EntryOfK&& entry_of_K, EntryOfA&& entry_of_A) noexcept {
  for (std::size_t i = 0; i < product.rows(); ++i)
    for (std::size_t j = 0; j < product.columns(); ++j) {
      ProductSum sum;
      for (std::size_t p = 0; p < terms; ++p) {
        const std::size_t e = entry_of_A(i, j, p);
        sum.add(&K.at(entry_of_K(i, j, p), 0), &A.lower(e, 0), &A.upper(e, 0));
      }
      const std::size_t e = i * product.columns() + j;
      sum.store(&product.lower(e, 0), &product.upper(e, 0));
    }
}

}  // namespace

regulus_function symbolic_product(const regulus_kernel& kernel, ProductForm form) noexcept {
  if (form.side == Side::kNone || form.numeric) return nullptr;
  return form.side == Side::kLeft ? kernel.left_product : kernel.right_product;
}

void multiply_left(ConstIntervalMatrix A, ConstPointMatrix K, IntervalMatrix product) noexcept {
  const std::size_t m = A.rows(), n = A.columns();
  multiply(
      A, K, product, m, [m](auto i, auto, auto p) { return i * m + p; },
      [n](auto, auto j, auto p) { return p * n + j; });
}

void multiply_right(ConstIntervalMatrix A, ConstPointMatrix K, IntervalMatrix product) noexcept {
  const std::size_t m = A.rows(), n = A.columns();
  multiply(
      A, K, product, n, [m](auto, auto j, auto p) { return p * m + j; },
      [n](auto i, auto, auto p) { return i * n + p; });
}

MatrixEvaluator::MatrixEvaluator(const BoxLanes& lanes, ProductForm form)
    : lanes_(lanes),
      kernel_(lanes.kernel()),
      form_(form),
      factor_(2 * std::size_t{kernel_.rows} * kernel_.columns * kLanes) {}

std::size_t MatrixEvaluator::rows(ProductForm form) const noexcept {
  return form.side == Side::kLeft ? kernel_.columns : kernel_.rows;
}

std::size_t MatrixEvaluator::columns(ProductForm form) const noexcept {
  return form.side == Side::kRight ? kernel_.rows : kernel_.columns;
}

LaneMask MatrixEvaluator::evaluate(ConstIntervalVector boxes, ConstPointMatrix K,
                                   IntervalMatrix matrix) noexcept {
  if (form_.side == Side::kNone) return lanes_.call(kernel_.matrix, boxes, nullptr, matrix.data());
  if (const regulus_function symbolic = symbolic_product(kernel_, form_))
    return lanes_.call(symbolic, boxes, K.data(), matrix.data());
  const LaneMask defined = lanes_.call(kernel_.matrix, boxes, nullptr, factor_.get());
  const ConstIntervalMatrix A(factor_.get(), kernel_.rows, kernel_.columns);
  form_.side == Side::kLeft ? multiply_left(A, K, matrix) : multiply_right(A, K, matrix);
  return defined;
}

DerivativeEvaluator::DerivativeEvaluator(const BoxLanes& lanes, MidpointEvaluator& midpoint,
                                         const EvaluationPlan& plan)
    : lanes_(lanes), midpoint_(midpoint), kernel_(lanes.kernel()), form_(plan.form) {
  const std::size_t of_one = 2 * kLanes * kernel_.columns;
  if (plan.sees_mean_values || plan.sharpens)
    derivatives_ = AlignedBuffer(of_one * kernel_.columns * lanes.variables());
  if (plan.sharpens) of_factor_ = AlignedBuffer(of_one * kernel_.rows * lanes.variables());
}

LaneMask DerivativeEvaluator::defined() noexcept {
  if (computed_.begin()) defined_ = evaluate();
  return defined_;
}

ConstIntervalMatrix DerivativeEvaluator::derivatives() noexcept {
  static_cast<void>(defined());
  return ConstIntervalMatrix(derivatives_.get(), lanes_.variables(),
                             std::size_t{kernel_.columns} * kernel_.columns);
}

LaneMask DerivativeEvaluator::evaluate() noexcept {
  if (form_ == ProductForm{Side::kLeft, false} && kernel_.left_derivatives != nullptr) {
    const ConstPointMatrix K = midpoint_.preconditioner();
    return midpoint_.preconditioned() &
           lanes_.call(kernel_.left_derivatives, lanes_.boxes(), K.data(), derivatives_.get());
  }
  double* of_A = form_.side == Side::kNone ? derivatives_.get() : of_factor_.get();
  const LaneMask defined = lanes_.call(kernel_.matrix_derivatives, lanes_.boxes(), nullptr, of_A);
  if (form_.side == Side::kNone) return defined;
  const std::size_t m = kernel_.rows, n = kernel_.columns;
  const ConstPointMatrix K = midpoint_.preconditioner();
  for (std::size_t k = 0; k < lanes_.variables(); ++k) {
    const ConstIntervalMatrix from(of_A + lower_at(k * m * n, 0), m, n);
    const IntervalMatrix to(derivatives_.get() + lower_at(k * n * n, 0), n, n);
    form_.side == Side::kLeft ? multiply_left(from, K, to) : multiply_right(from, K, to);
  }
  return defined & midpoint_.preconditioned();
}

}  // namespace regulus::detail
