// SPDX-License-Identifier: Apache-2.0
// Bounds of |KA − I| over the boxes of a batch.
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
  const double* entries = product({ProductForm::Side::kLeft, false}, defined);
  distance_to_identity_ru(entries, columns_, bounds_.get());
  for_each_lane(kAllLanes & ~defined, [this](std::size_t lane) {
    fill_lane(bounds_.get(), columns_ * columns_, lane, kInfinity);
  });
  return bounds_.get();
}

double* Batch::mean_value_bounds() noexcept {
  double* bounds = natural_bounds();
  if (!sees_mean_values_ || !begin(kMeanValue)) return bounds;
  compute_derivatives();
  derivatives_defined_ &=
      call(kernel_.left_product, thin_.get(), preconditioner(), scratch_.get()) & preconditioned();
  distance_to_identity_ru(scratch_.get(), columns_, center_.get());
  lower_to_mean_value_ru(center_.get(), derivatives_.get(), radius_.get(), columns_, variables_,
                         derivatives_defined_, bounds);
  return bounds;
}

LaneMask Batch::call_listed(const regulus_derivatives& derivatives, const double* boxes,
                            double* out) noexcept {
  if (derivatives.function == nullptr) return kAllLanes;
  return call(derivatives.function, boxes, preconditioner(), out);
}

SecondOrderInput Batch::second_order_input() noexcept {
  return {preconditioner(), center_product_.get(), first_.get(),          second_.get(),
          row_first_.get(), row_second_.get(),     expanded_radius_.get()};
}

double* Batch::second_order_bounds() noexcept {
  double* T = second_order_bounds_.get();
  if (!begin(kSecondOrder)) return T;
  const regulus_expansion& x = *kernel_.expansion;
  load_expansion_point();
  LaneMask defined = preconditioned() & ~expansion_outside_contract_;
  defined &= call(x.product, expanded_.get(), preconditioner(), center_product_.get());
  defined &= call_listed(x.first, expanded_.get(), first_.get());
  defined &= call_listed(x.row_first, expanded_.get(), row_first_.get());
  defined &= call_listed(x.second, boxes_.get(), second_.get());
  defined &= call_listed(x.row_second, boxes_.get(), row_second_.get());
  // Any of the kernel's functions says where A is not defined.
  if (x.second.function == nullptr && x.row_second.function == nullptr)
    static_cast<void>(product({}, defined));
  second_order_->bound_ru(second_order_input(), T);
  second_order_defined_ = defined;
  for_each_lane(kAllLanes & ~defined,
                [&](std::size_t lane) { fill_lane(T, order() * order(), lane, kInfinity); });
  return T;
}

LaneMask Batch::certain_by_orthants(LaneMask lanes) noexcept {
  if (lanes == 0) return 0;
  const double* T = second_order_bounds();
  if (begin(kPerron)) compute_perron();
  return second_order_->certain_by_orthants(second_order_input(), T, right_perron_.get(), lanes,
                                            orthant_hint_);
}

void Batch::moving_determinant_ru(double* upper) noexcept {
  static_cast<void>(second_order_bounds());
  second_order_->moving_determinant_ru(second_order_input(), upper);
}

}  // namespace regulus
