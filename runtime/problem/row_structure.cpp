// SPDX-License-Identifier: Apache-2.0
#include "runtime/problem/row_structure.hpp"

#include <algorithm>

namespace regulus::detail {
namespace {

std::size_t slot_of(std::vector<std::size_t>& rows, std::size_t row) {
  const auto known = std::find(rows.begin(), rows.end(), row);
  if (known != rows.end()) return static_cast<std::size_t>(known - rows.begin());
  rows.push_back(row);
  return rows.size() - 1;
}

bool has_row_variable(const regulus_kernel& kernel) noexcept {
  const int* rows = kernel.expansion->row_of_variable;
  return std::any_of(rows, rows + kernel.variables, [](int row) { return row >= 0; });
}

}  // namespace

bool uses_expansion(const regulus_kernel& kernel, const Settings& settings) noexcept {
  if (settings.method != Method::kAuto || kernel.expansion == nullptr) return false;
  if (!settings.ingredients.second_order) return false;
  // An expansion that treats quantities by their row has no other derivatives by them.
  if (!settings.ingredients.rows && has_row_variable(kernel)) return false;
  return kernel.expansion->nominal == nullptr || settings.uncertainty == Uncertainty::kElements;
}

RowStructure find_row_structure(const Problem& problem, const Settings& settings) {
  const regulus_kernel& kernel = *problem.kernel;
  RowStructure structure;
  if (!uses_expansion(kernel, settings)) return structure;
  structure.slot.assign(kernel.variables, RowStructure::kWide);
  for (std::size_t k = kernel.motion_variables; k < kernel.variables; ++k)
    if (const int row = kernel.expansion->row_of_variable[k]; row >= 0)
      structure.slot[k] = static_cast<int>(slot_of(structure.rows, static_cast<std::size_t>(row)));
  // A box that may be split in them has only part of a ball, and more than that part.
  if (settings.ingredients.balls && kernel.expansion->nominal != nullptr &&
      kernel.expansion->ball_of_variable != nullptr)
    structure.ball.assign(kernel.expansion->ball_of_variable,
                          kernel.expansion->ball_of_variable + kernel.variables);
  return structure;
}

}  // namespace regulus::detail
