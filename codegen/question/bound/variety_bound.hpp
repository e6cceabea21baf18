// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds one component over a set of poses.
#pragma once

#include "codegen/question/bound/bound_run.hpp"
#include "codegen/support/time_budget.hpp"

namespace regulus::detail {

/// Brackets the component, or compares it with the limit, by searches of the matrix B(r) of
/// question/quantity/bordered.hpp.
///
/// Throws    as bound_quantity().
[[nodiscard]] ComponentBound bound_over_variety(const Request& request, const Component& component,
                                                const BoundSettings& settings,
                                                const TimeBudget& budget);

}  // namespace regulus::detail
