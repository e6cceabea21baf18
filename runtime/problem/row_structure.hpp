// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/problem/problem.hpp"
#include "runtime/regularity/row_structure.hpp"

namespace regulus {

/// Whether the search uses the kernel's expansion. One at nominal values is of no use where
/// uncertain quantities are bisected.
[[nodiscard]] bool uses_expansion(const regulus_kernel& kernel, const Settings& settings) noexcept;

/// The uncertain quantities that touch one row of the matrix only, as the kernel's expansion says.
/// Empty when the search does not use it.
[[nodiscard]] RowStructure find_row_structure(const Problem& problem, const Settings& settings);

}  // namespace regulus
