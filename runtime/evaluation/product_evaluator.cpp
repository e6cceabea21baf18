// SPDX-License-Identifier: Apache-2.0
#include "runtime/evaluation/product_evaluator.hpp"

namespace regulus::detail {
namespace {

using Side = ProductForm::Side;

}  // namespace

ProductEvaluator::ProductEvaluator(const BoxLanes& lanes, MidpointEvaluator& midpoint,
                                   DerivativeEvaluator& derivatives, MatrixEvaluator& matrix,
                                   const EvaluationPlan& plan)
    : lanes_(lanes), midpoint_(midpoint), matrix_(matrix), kernel_(lanes.kernel()) {
  if (plan.sharpens)
    sharpener_ = std::make_unique<EntrySharpener>(lanes, midpoint, derivatives, matrix);
  const std::size_t m = kernel_.rows, n = kernel_.columns;
  plain_.entries = AlignedBuffer(2 * m * n * kLanes);
  for (Enclosure* left : {&left_, &left_numeric_})
    left->entries = AlignedBuffer(2 * n * n * kLanes);
  for (Enclosure* right : {&right_, &right_numeric_})
    right->entries = AlignedBuffer(2 * m * m * kLanes);
}

void ProductEvaluator::forget() noexcept {
  sharpened_.forget();
  for (Enclosure* enclosure : {&plain_, &left_, &right_, &left_numeric_, &right_numeric_})
    enclosure->computed.forget();
}

/// If the kernel has no function for a product, the product is computed from A.
ProductEvaluator::Enclosure& ProductEvaluator::enclosure_of(ProductForm form) noexcept {
  if (form.side == Side::kNone) return plain_;
  const bool symbolic = symbolic_product(kernel_, form) != nullptr;
  if (form.side == Side::kLeft) return symbolic ? left_ : left_numeric_;
  return symbolic ? right_ : right_numeric_;
}

IntervalMatrix ProductEvaluator::view(Enclosure& enclosure, ProductForm form) const noexcept {
  return IntervalMatrix(enclosure.entries.get(), matrix_.rows(form), matrix_.columns(form));
}

IntervalMatrix ProductEvaluator::compute(ProductForm form, LaneMask& lanes) noexcept {
  if (form.side != Side::kNone) lanes &= midpoint_.preconditioned();
  Enclosure& result = enclosure_of(form);
  const IntervalMatrix entries = view(result, form);
  if (const regulus_function symbolic = symbolic_product(kernel_, form)) {
    if (result.computed.begin())
      result.defined =
          lanes_.call(symbolic, lanes_.boxes(), midpoint_.preconditioner().data(), entries.data());
    lanes &= result.defined & lanes_.loaded();
    return entries;
  }
  if (plain_.computed.begin())
    plain_.defined = lanes_.call(kernel_.matrix, lanes_.boxes(), nullptr, plain_.entries.get());
  lanes &= plain_.defined & lanes_.loaded();
  if (form.side == Side::kNone || !result.computed.begin()) return entries;
  const ConstIntervalMatrix A = view(plain_, {});
  const ConstPointMatrix K = midpoint_.preconditioner();
  form.side == Side::kLeft ? multiply_left(A, K, entries) : multiply_right(A, K, entries);
  return entries;
}

ConstIntervalMatrix ProductEvaluator::product(ProductForm form, LaneMask& lanes) noexcept {
  const IntervalMatrix entries = compute(form, lanes);
  if (sharpener_ && form == matrix_.form() && sharpened_.begin())
    sharpener_->sharpen(entries, lanes);
  return entries;
}

}  // namespace regulus::detail
