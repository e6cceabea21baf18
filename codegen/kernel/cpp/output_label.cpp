// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/output_label.hpp"

namespace regulus::detail {
namespace {

std::string entry(const std::string& matrix, std::size_t index, std::size_t columns) {
  return matrix + "[" + std::to_string(index / columns) + "][" + std::to_string(index % columns) +
         "]";
}

}  // namespace

std::string output_label(const Module& module, const Function& function, std::size_t output) {
  const auto rows = static_cast<std::size_t>(module.rows);
  const auto columns = static_cast<std::size_t>(module.columns);
  if (function.name == "matrix") return entry("A", output, columns);
  if (function.name == "matrix_derivatives")
    return entry("∂A", output % (rows * columns), columns) + "/∂" +
           module.variables[output / (rows * columns)];
  if (function.name == "left_product") return entry("(K·A)", output, columns);
  if (function.name == "right_product") return entry("(A·K)", output, rows);
  if (function.name == "left_derivatives")
    return entry("∂(K·A)", output % (columns * columns), columns) + "/∂" +
           module.variables[output / (columns * columns)];
  if (function.name == "determinant") return "det A";
  if (function.name == "determinant_derivatives") return "∂ det A/∂" + module.variables[output];
  if (function.name == "nominal_product") return entry("(K·A)", output, columns);
  if (!function.derivatives.empty()) {
    const DerivativeIndex& d = function.derivatives[output];
    const bool of_row = function.name == "row_first" || function.name == "row_second";
    std::string by = "/∂" + module.variables[static_cast<std::size_t>(d.first)];
    if (d.second != DerivativeIndex::kNone)
      by += "∂" + module.variables[static_cast<std::size_t>(d.second)];
    return std::string(of_row ? "∂A[" : "∂(K·A)[") + std::to_string(d.row) + "][" +
           std::to_string(d.column) + "]" + by;
  }
  if (function.name == "row_scale") return "product of the row scales";
  return function.name + "[" + std::to_string(output) + "]";
}

}  // namespace regulus::detail
