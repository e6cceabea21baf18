// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace regulus::detail {

/// Returns "(1, 2, 3) N, (0, 0, 0.5) N m": the components with five digits, those of one unit that follow
/// each other in one pair of brackets. `units`: by component; a missing one or "1" is none.
[[nodiscard]] std::string vector_text(const std::vector<double>& values,
                                      const std::vector<std::string>& units);

}  // namespace regulus::detail
