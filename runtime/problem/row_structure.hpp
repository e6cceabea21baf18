// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/problem/problem.hpp"
#include "runtime/regularity/row_structure.hpp"

namespace regulus::detail {

/// Returns true if the search uses the kernel's expansion. An expansion at nominal values cannot be
/// used if uncertain quantities are bisected.
[[nodiscard]] bool uses_expansion(const regulus_kernel& kernel, const Settings& settings) noexcept;

/// Returns the uncertain quantities that touch one row of the matrix only, as the kernel's
/// expansion says. Empty if the search does not use the expansion.
[[nodiscard]] RowStructure find_row_structure(const Problem& problem, const Settings& settings);

}  // namespace regulus::detail
