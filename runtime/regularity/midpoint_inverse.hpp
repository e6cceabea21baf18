// SPDX-License-Identifier: Apache-2.0
// The preconditioner K ≈ A(t₀)⁻¹, in plain doubles. Any K is sound; a bad one only decides
// nothing.
#pragma once

#include "runtime/regularity/lanes.hpp"
#include "runtime/regularity/views.hpp"

namespace regulus::detail {

/// Inverts eight m×n matrices approximately; for m > n a left inverse, (AᵀA)⁻¹Aᵀ.
///
/// Shape     matrix m×n, inverse n×m. determinant: of A for m = n and of the column-scaled AᵀA
///           otherwise.
///           Each row of the inverse is rounded to a grid of 28 bits: entries are multiples of one
///           power of two, at most 2^28 times that, so that short sums of them are exact.
/// Requires  kMaxRows ≥ m ≥ n ≥ 1, kMaxColumns ≥ n. Not in place.
/// Ensures   returns the lanes for which no finite inverse was found, or one with a row so small
///           that it has no grid (below 2^-800); their entries are meaningless.
/// Rounding  none: no result here is a bound.
[[nodiscard]] LaneMask approx_inverse(ConstPointMatrix matrix, PointMatrix inverse,
                                      LaneNumbers& approx_determinant) noexcept;

}  // namespace regulus::detail
