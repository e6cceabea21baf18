// SPDX-License-Identifier: GPL-3.0-or-later
// A matrix whose determinant is known, and cannot be seen.
#pragma once

#include <string>
#include <vector>

#include "tests/attack/oracle/attack.hpp"
#include "tests/attack/oracle/random.hpp"

namespace regulus::attack {

/// P·L·diag(factors)·U·Q with unit triangular L, U and permutations P, Q: the determinant is the
/// product of the factors, or its negative. Entries of L and U are small rational numbers, or
/// polynomials and functions of `names` that have a value everywhere.
[[nodiscard]] std::vector<std::vector<Cell>> hidden_product(std::vector<std::string> factors,
                                                            const std::vector<std::string>& names,
                                                            Random& random);

}  // namespace regulus::attack
