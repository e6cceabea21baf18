// SPDX-License-Identifier: GPL-3.0-or-later
// A matrix whose determinant is known, but cannot be seen in its entries.
#pragma once

#include <string>
#include <vector>

#include "tests/attack/oracle/attack.hpp"
#include "tests/attack/oracle/random.hpp"

namespace regulus::detail::attack {

/// Returns P·L·diag(factors)·U·Q with unit triangular L, U and permutations P, Q. Its determinant
/// is ± the product of the factors. Entries of L and U are small rational numbers, or polynomials
/// and functions of `names` that have a value everywhere.
[[nodiscard]] std::vector<std::vector<Cell>> hidden_product(std::vector<std::string> factors,
                                                            const std::vector<std::string>& names,
                                                            Random& random);

}  // namespace regulus::detail::attack
