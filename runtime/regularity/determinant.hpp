// SPDX-License-Identifier: Apache-2.0
// Determinants of interval matrices. The entries count as independent, so this is not tight.
#pragma once

#include <array>

#include "runtime/interval/interval.hpp"
#include "runtime/regularity/lanes.hpp"
#include "runtime/regularity/views.hpp"

namespace regulus::detail {

/// The square interval matrix of one lane, row-major, n ≤ kMaxColumns.
struct LaneMatrix {
  std::size_t n = 0;
  std::array<Interval, kMaxColumns * kMaxColumns> entries;

  [[nodiscard]] Interval& at(std::size_t i, std::size_t j) noexcept { return entries[i * n + j]; }
  [[nodiscard]] const Interval& at(std::size_t i, std::size_t j) const noexcept {
    return entries[i * n + j];
  }
};

/// Returns one lane of a square matrix.
[[nodiscard]] LaneMatrix matrix_of_lane(ConstIntervalMatrix x, std::size_t lane) noexcept;

/// Returns the same as thin intervals.
[[nodiscard]] LaneMatrix matrix_of_lane(ConstPointMatrix x, std::size_t lane) noexcept;

/// The largest order that is expanded; the work grows with its factorial.
inline constexpr std::size_t kMaxExpansion = 7;

/// Encloses det(M) by expansion along the row or column of least mean width.
///
/// Shape     M is n×n, 1 ≤ n ≤ kMaxColumns; above kMaxExpansion elimination is used instead.
/// Requires  every entry bounded.
/// Ensures   det(A) ∈ result for every real A with A[i][j] ∈ M[i][j].
/// Rounding  outward at each operation.
/// Source    Merlet, T-RO 2007, §III-A.
[[nodiscard]] Interval enclose_determinant(const LaneMatrix& M) noexcept;

/// Encloses det(M) by Gaussian elimination, with pivots of largest mignitude. If every candidate
/// for a pivot contains 0, the rest is expanded.
///
/// Requires, Ensures, Rounding  as enclose_determinant; [−∞, ∞] if more than kMaxExpansion rows
///           remain without a pivot.
[[nodiscard]] Interval enclose_determinant_by_elimination(const LaneMatrix& M) noexcept;

/// Returns the sign of all determinants: +1, −1, or 0 if a common sign was not shown.
[[nodiscard]] constexpr int certain_sign(const Interval& x) noexcept {
  return x.lo > 0.0 ? 1 : x.hi < 0.0 ? -1 : 0;
}

}  // namespace regulus::detail
