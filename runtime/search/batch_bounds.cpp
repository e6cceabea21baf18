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
  const double* entries = left_.get();
  if (is_structured())
    defined &= product_on(nominal_.get(), preconditioner(), left_.get());
  else
    entries = product({ProductForm::Side::kLeft, false}, defined);
  distance_to_identity_ru(entries, columns_, bounds_.get());
  for_each_lane(kEveryLane & ~defined, [this](std::size_t lane) {
    fill_lane(bounds_.get(), columns_ * columns_, lane, kInfinity);
  });
  return bounds_.get();
}

double* Batch::mean_value_bounds() noexcept {
  double* bounds = natural_bounds();
  if (!sees_mean_values_ || !begin(kMeanValue)) return bounds;
  compute_derivatives();
  const LaneMask center_defined =
      call(kernel_.left_product, thin_.get(), preconditioner(), scratch_.get());
  distance_to_identity_ru(scratch_.get(), columns_, center_.get());
  derivatives_defined_ &= center_defined;
  lower_to_mean_value_ru(center_.get(), derivatives_.get(), wide_radius_.get(), columns_,
                         variables_, derivatives_defined_, bounds);
  return bounds;
}

StructuredInput Batch::structured_input() noexcept {
  return {rows_,
          columns_,
          variables_,
          bounds_.get(),
          center_.get(),
          preconditioner_.get(),
          derivatives_.get(),
          derivatives_defined_,
          full_derivatives_.get(),
          radius_.get(),
          slopes_.get()};
}

double* Batch::structured_bounds() noexcept {
  static_cast<void>(mean_value_bounds());
  if (!begin(kStructured)) return structured_.get();
  LaneMask defined =
      call(kernel_.left_derivatives, boxes_.get(), preconditioner(), full_derivatives_.get()) &
      preconditioned();
  // The matrix, too, must be defined for all uncertain values.
  static_cast<void>(product({}, defined));
  structured_bounds_ru(structure_, structured_input(), structured_.get());
  for_each_lane(kEveryLane & ~defined, [this](std::size_t lane) {
    fill_lane(structured_.get(), order() * order(), lane, kInfinity);
  });
  return structured_.get();
}

}  // namespace regulus
