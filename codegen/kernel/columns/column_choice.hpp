// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses whether A or A·V is searched: the one with narrower bounds.
#pragma once

#include <vector>

#include "codegen/kernel/columns/approx_bounds.hpp"
#include "codegen/kernel/columns/column_operations.hpp"
#include "codegen/kernel/columns/column_trials.hpp"

namespace regulus::detail {

struct ColumnDecision {
  std::vector<ColumnOperation> kept;
  ColumnTrials trials;
};

/// Compares A with its forms after the shortening operations and after half of each.
///
/// Ensures   multipliers are free of quantities that touch one row only, so these still touch one
///           row.
[[nodiscard]] ColumnDecision choose_columns(const PolynomialMatrix& A, Rewriter& rewriter,
                                            const BoundsSetting& setting);

}  // namespace regulus::detail
