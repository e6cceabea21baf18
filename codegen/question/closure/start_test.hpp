// SPDX-License-Identifier: GPL-3.0-or-later
// The one configuration near the values of a start.
#pragma once

#include <string>

#include "codegen/question/closure/branch_links.hpp"

namespace regulus::detail {

/// Returns why exactly one configuration is not shown to be within the radius of the values; empty if it
/// is.
[[nodiscard]] std::string obstacle_of_start(SystemBoxes& system, const ClosedShape& shape,
                                            const BranchStart& start);

}  // namespace regulus::detail
