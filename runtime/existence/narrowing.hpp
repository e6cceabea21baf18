// SPDX-License-Identifier: Apache-2.0
// Narrows a box to the solutions of linear equations with interval coefficients.
#pragma once

#include <span>

#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// Narrows x to the hull of the parts of it that b + A(x − c) = 0 leaves, one row and one unknown
/// after another: x_j − c_j ∈ −(b_i + Σ_{k≠j} A_ik(x_k − c_k))/A_ij, also where A_ij contains 0.
///
/// Shape     A: m×n, row-major; b: m; c, x: n.
/// Ensures   every x of the box for which some matrix of A and some vector of b solve all m equations
///           is in what is left; false if nothing is left, and then the box has no meaning.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] bool narrow_by_rows(std::span<const Interval> A, std::span<const Interval> b,
                                  std::span<const double> c, std::span<Interval> x) noexcept;

}  // namespace regulus::detail
