// SPDX-License-Identifier: Apache-2.0
// The properties of the problem and the method that the evaluators of a Batch need.
#pragma once

#include "runtime/problem/problem.hpp"

namespace regulus::detail {

struct EvaluationPlan {
  ProductForm form;           ///< of the matrix that the method uses
  bool sharpens;              ///< narrows its entries by their derivatives
  bool sees_mean_values;      ///< the method uses them and the kernel has derivatives
  bool sees_determinant;      ///< the method uses its closed form
  std::size_t splittable;     ///< the variables 0 … splittable − 1 may be split
  bool weighs_row_variables;  ///< some of them are uncertain quantities
  bool moves_preconditioner;  ///< Ingredients::moving
};

[[nodiscard]] EvaluationPlan make_plan(const Problem& problem, const Settings& settings) noexcept;

}  // namespace regulus::detail
