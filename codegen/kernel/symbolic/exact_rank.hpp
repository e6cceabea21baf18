// SPDX-License-Identifier: GPL-3.0-or-later
// The rank of a matrix at a point whose coordinates are known exactly.
#pragma once

#include <ginac/ginac.h>

#include <cstddef>
#include <map>
#include <string>

#include "codegen/kernel/symbolic/expression.hpp"

namespace regulus::detail {

/// Computes det A, or det AᵀA if A has more rows than columns, with exact numbers: rationals, their
/// roots, and the sines and cosines of multiples of pi/12. Functions of other numbers are taken as
/// indeterminates, with sin²u + cos²u = 1.
///
/// Shape     A is rows×columns, row-major, rows ≥ columns.
/// Requires  `values` has an expression without symbols for every variable of A.
/// Ensures   true only if A has less than full column rank at that point, if it is defined there.
///           False says nothing.
[[nodiscard]] bool is_rank_lost(const Expressions& A, std::size_t rows, std::size_t columns,
                                const std::map<std::string, GiNaC::ex>& values);

}  // namespace regulus::detail
