// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/formulation/functions_needed.hpp"

namespace regulus::detail {

FormulationOptions functions_needed(Method method, const Settings& settings,
                                    std::uint64_t symbolic_budget) {
  const ProductForm form = form_of(method);
  const bool derivatives = settings.entries == Entries::kDerivatives;
  FormulationOptions options;
  if (method == Method::kAuto)
    options.expansion = settings.uncertainty == Uncertainty::kElements ? ExpansionForm::kAtNominal
                                                                       : ExpansionForm::kAtBox;
  options.left_product = form == ProductForm{ProductForm::Side::kLeft, false};
  options.right_product = form == ProductForm{ProductForm::Side::kRight, false};
  options.derivatives = options.left_product && (derivatives || method == Method::kAuto);
  options.matrix_derivatives = derivatives && !options.left_product;
  if (form.side == ProductForm::Side::kLeft)
    options.columns =
        method == Method::kAuto ? ColumnSearch::kSecondOrder : ColumnSearch::kFirstOrder;
  options.determinant = method == Method::kClosedForm;
  options.determinant_budget = symbolic_budget;
  return options;
}

}  // namespace regulus::detail
