// SPDX-License-Identifier: Apache-2.0
#include "runtime/evaluation/evaluation_plan.hpp"

namespace regulus::detail {
namespace {

/// Left products have their own derivatives; those of the others follow from those of A.
bool knows_derivatives(const regulus_kernel& kernel, ProductForm form) noexcept {
  if (form == ProductForm{ProductForm::Side::kLeft, false} && kernel.left_product != nullptr)
    return kernel.left_derivatives != nullptr;
  return kernel.matrix_derivatives != nullptr;
}

}  // namespace

EvaluationPlan make_plan(const Problem& problem, const Settings& settings) noexcept {
  const regulus_kernel& kernel = *problem.kernel;
  const Method method = settings.method;
  EvaluationPlan plan{};
  plan.form = form_of(method);
  plan.sharpens = settings.entries == Entries::kDerivatives && method != Method::kAuto &&
                  method != Method::kClosedForm && knows_derivatives(kernel, plan.form);
  plan.sees_mean_values = method == Method::kAuto && kernel.left_derivatives != nullptr &&
                          kernel.left_product != nullptr;
  plan.sees_determinant = method == Method::kClosedForm;
  plan.splittable =
      settings.uncertainty == Uncertainty::kVariables ? kernel.variables : kernel.motion_variables;
  plan.weighs_row_variables = plan.splittable > kernel.motion_variables;
  plan.moves_preconditioner = settings.ingredients.moving;
  return plan;
}

}  // namespace regulus::detail
