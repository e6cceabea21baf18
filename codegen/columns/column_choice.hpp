// SPDX-License-Identifier: GPL-3.0-or-later
// Whether A or A·V is searched: the one for which bounds are narrower.
#pragma once

#include <vector>

#include "codegen/columns/approx_bounds.hpp"
#include "codegen/columns/column_operations.hpp"
#include "codegen/columns/column_trials.hpp"

namespace regulus::inline columns {

struct ColumnDecision {
  std::vector<ColumnOperation> kept;
  ColumnTrials trials;
};

/// Compares A with what the shortening operations make of it, wholly and half-way.
///
/// Ensures   multipliers are free of quantities that touch one row only, so that these still do.
[[nodiscard]] ColumnDecision choose_columns(const PolynomialMatrix& A, Rewriter& rewriter,
                                            const BoundsSetting& setting);

}  // namespace regulus::inline columns
