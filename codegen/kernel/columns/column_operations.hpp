// SPDX-License-Identifier: GPL-3.0-or-later
// Operations on the columns of A that do not change its determinant, nor its singular set.
//
// A·V is searched instead of A, for a V that is a product of elementary operations
//
//     column target += factor · multiplier · column source,      target ≠ source,
//
// each of determinant 1 at every pose. In A·V variables may occur less often. For example, the
// model has the moments of a platform's legs about a point of the platform, and A·V has them about
// a point of the base. (d, R·b × (X − a)) becomes (d, a × (X + R·b)) by two operations on each
// moment.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "codegen/kernel/symbolic/polynomial.hpp"

namespace regulus::detail {

struct ColumnOperation {
  int target = 0;
  int source = 0;
  cln::cl_RA factor;       ///< not 0
  AtomProduct multiplier;  ///< of variable atoms, at least one
};

/// An m×n matrix of polynomials, row-major.
struct PolynomialMatrix {
  int columns = 0;
  std::vector<Polynomial> entries;

  [[nodiscard]] int rows() const { return static_cast<int>(entries.size()) / columns; }
  [[nodiscard]] Polynomial& at(int row, int column) {
    return entries[static_cast<std::size_t>(row * columns + column)];
  }
  [[nodiscard]] const Polynomial& at(int row, int column) const {
    return entries[static_cast<std::size_t>(row * columns + column)];
  }
};

/// Requires  target ≠ source.
/// Ensures   every minor that has the whole column `target` and column `source` keeps its value:
///           for m = n the determinant, for m > n the rank.
void apply(const ColumnOperation& operation, PolynomialMatrix& A);

/// The operations that cancel terms, found one after another; each leaves the fewest terms in its
/// target.
struct ShorteningOperations {
  std::vector<ColumnOperation> operations;
  std::size_t terms_before = 0;
  std::size_t terms_after = 0;
  bool complete = true;  ///< false: the budget ended the search
};

/// `may_multiply` selects the atoms that a multiplier may contain. `most_pairs` bounds the pairs of
/// terms that are compared: a number, not a time, so that every run finds the same operations.
[[nodiscard]] ShorteningOperations find_shortening_operations(
    PolynomialMatrix A, const std::function<bool(Atom)>& may_multiply, std::uint64_t most_pairs);

/// Returns the same operations with each factor times `part`.
[[nodiscard]] std::vector<ColumnOperation> scaled(std::vector<ColumnOperation> operations,
                                                  const cln::cl_RA& part);

}  // namespace regulus::detail
