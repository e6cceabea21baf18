// SPDX-License-Identifier: GPL-3.0-or-later
// How far something can grow while a quantity keeps a limit over a branch.
#pragma once

#include "codegen/question/bound/limit_margin.hpp"

namespace regulus::detail {

/// For LimitMarginSettings::over_branch: each value is compared with the limit by a search of its own.
///
/// Throws    as limit_margin().
[[nodiscard]] ComponentMargin margin_over_branch(const Request& request, const Component& component,
                                                 const MarginQuestion& question,
                                                 const LimitMarginSettings& settings,
                                                 const BracketSettings& bracket,
                                                 const TimeBudget& budget);

}  // namespace regulus::detail
