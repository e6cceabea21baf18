// SPDX-License-Identifier: Apache-2.0
// The functions that a kernel can have. This is the only table of them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "runtime/kernel/abi.hpp"

namespace regulus::detail {

/// In the order of the table's rows.
enum class KernelFunction : unsigned char {
  kMatrix,
  kMatrixDerivatives,
  kLeftProduct,
  kLeftDerivatives,
  kRightProduct,
  kRowScale,
  kConstraint,
  kPose,
  kDeterminant,
  kDeterminantDerivatives,
  kNominalProduct,
  kNominalFirst,
  kExpansionSecond,
  kRowFirst,
  kRowSecond,
};

struct KernelFunctionRow {
  std::string_view name;
  /// The function's field of regulus_kernel; null for functions that only regulus_expansion names.
  regulus_function regulus_kernel::*field;
};

inline constexpr std::array<KernelFunctionRow, 15> kKernelFunctions = {{
    {"matrix", &regulus_kernel::matrix},
    {"matrix_derivatives", &regulus_kernel::matrix_derivatives},
    {"left_product", &regulus_kernel::left_product},
    {"left_derivatives", &regulus_kernel::left_derivatives},
    {"right_product", &regulus_kernel::right_product},
    {"row_scale", &regulus_kernel::row_scale},
    {"constraint", &regulus_kernel::constraint},
    {"pose", &regulus_kernel::pose},
    {"determinant", &regulus_kernel::determinant},
    {"determinant_derivatives", &regulus_kernel::determinant_derivatives},
    {"nominal_product", nullptr},
    {"nominal_first", nullptr},
    {"expansion_second", nullptr},
    {"row_first", nullptr},
    {"row_second", nullptr},
}};

[[nodiscard]] constexpr std::string_view name(KernelFunction function) noexcept {
  return kKernelFunctions[static_cast<std::size_t>(function)].name;
}

/// Returns the function of that name; nullopt for any other word.
[[nodiscard]] constexpr std::optional<KernelFunction> parse_kernel_function(
    std::string_view word) noexcept {
  for (std::size_t i = 0; i < kKernelFunctions.size(); ++i)
    if (kKernelFunctions[i].name == word) return static_cast<KernelFunction>(i);
  return std::nullopt;
}

}  // namespace regulus::detail
