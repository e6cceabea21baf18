// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "codegen/kernel/program/interpreter.hpp"
#include "codegen/kernel/program/program.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// Marks the nodes whose value is a double that arithmetic in doubles computes exactly in any
/// rounding mode: sums of entries of one row of K with short coefficients.
///
/// By the ABI a row of K lies on a grid: its entries are g·i, |i| < 2^29, with one power of two
/// g ≥ 2^-828. Induction over the nodes: each is g·2^-s·i for an integer |i| ≤ b. An entry has s =
/// 0 and b = 2^29; a sum brings both operands to the finer scale and adds their bounds; a
/// coefficient p·2^-q, p an integer, adds q to s and multiplies b by |p|. A node with b ≤ 2^53 and
/// s ≤ 128 is a double, since g·2^-s is a multiple of 2^-1074; so are all intermediate values.
///
/// Requires  points row by row, `row_length` in each; 0 if the rows are not known.
/// Ensures   entries of K count as exact, constants do not.
[[nodiscard]] std::vector<bool> exact_nodes(const Program& program,
                                            const KnownValues<Interval>& known,
                                            std::size_t row_length);

}  // namespace regulus::detail
