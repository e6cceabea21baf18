// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "regulus/regularity/structured.hpp"
#include "regulus/search/problem.hpp"

namespace regulus {

/// Finds the uncertain quantities that touch one row of the matrix only.
///
/// Ensures   a variable is given row l only if its partial derivatives of all other rows are 0 all
///           over the problem's box, as proved by enclosures that are exactly [0, 0] there. Empty
///           when the method does not use it, or derivatives are missing or not defined everywhere.
[[nodiscard]] RowStructure find_row_structure(const Problem& problem, const Settings& settings);

}  // namespace regulus
