// SPDX-License-Identifier: GPL-3.0-or-later
// Powers of two by which the rows and columns of a matrix are multiplied if their scales are too
// far apart.
//
// The author chooses the units, so no verdict may depend on them. But a kernel takes K's entries up
// to 2^128, and the entries of one row on one grid of 29 bits: if one row of A is 2^-40 times
// another, K loses all its digits. With R and C diagonal matrices of powers of two, RAC is as
// regular as A, its entries are the same expressions with other constants, and det RAC = 2^e det A
// exactly.
#pragma once

#include <vector>

#include "codegen/kernel/symbolic/expression.hpp"
#include "codegen/kernel/symbolic/variable.hpp"
#include "codegen/support/work_meter.hpp"

namespace regulus::detail {

struct MatrixScaling {
  std::vector<int> rows, columns;  ///< exponents of two; both empty: A stays as it is

  [[nodiscard]] bool empty() const noexcept { return rows.empty(); }
  /// Returns the e of det RAC = 2^e det A, for a square matrix.
  [[nodiscard]] int determinant_exponent() const noexcept;
  /// 2^(rows[i] + columns[j])·entry.
  [[nodiscard]] Expression apply(const Expression& entry, int row, int column) const;
};

/// 2^e, exactly.
[[nodiscard]] cln::cl_RA power_of_two(int e);

/// Finds powers of two such that no entry is greater than about 1 and some permutation of the rows
/// has a diagonal of entries near 1, judged by the magnitudes of the entries at a few points.
///
/// Shape     entries row-major, m×n, m ≥ n.
/// Ensures   empty if the scales are not far apart, so that most matrices stay as they are, and if
///           nothing is known: an entry is undefined at all points, or the matrix has no diagonal
///           of entries that are not zero. Matrices that differ by powers of two in rows and
///           columns are scaled to the same matrix, if they are scaled. With `moderate`, also empty
///           if 2^-e is not well within the doubles, because a threshold needs 2^-e. `meter`, if
///           any, counts the nodes that are evaluated.
/// Source    the diagonal: Olschowka and Neumaier, "A new pivoting strategy for Gaussian
///           elimination", Linear Algebra Appl. 240 (1996).
[[nodiscard]] MatrixScaling find_scaling(const Expressions& entries, int columns,
                                         const std::vector<Variable>& variables, bool moderate,
                                         WorkMeter* meter = nullptr);

}  // namespace regulus::detail
