// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/attack/forge/bases.hpp"

namespace regulus::detail::attack {

/// Branches of closures, and quantities over them.
[[nodiscard]] std::vector<Base> of_mechanisms();
[[nodiscard]] std::vector<Base> of_paved_branches();
[[nodiscard]] std::vector<Base> of_branches_in_shards();
/// Lists of solutions.
[[nodiscard]] std::vector<Base> of_solutions();

}  // namespace regulus::detail::attack
