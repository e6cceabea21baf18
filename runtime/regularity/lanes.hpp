// SPDX-License-Identifier: Apache-2.0
// The largest matrices of the regularity tests, and upper bounds of sums of non-negative
// terms.
#pragma once

#include "runtime/interval/lanes.hpp"

namespace regulus {

/// Larger matrices are refused before a search, so that workspaces fit on the stack.
inline constexpr std::size_t kMaxColumns = 16;
inline constexpr std::size_t kMaxRows = 24;

/// The largest order of a matrix P given to the H-matrix test
/// (runtime/regularity/second_order.hpp).
inline constexpr std::size_t kMaxOrder = kMaxColumns + kMaxRows;

/// The most coordinates of one ball that are treated together.
inline constexpr std::size_t kMaxBall = 16;

/// Returns the factor of raise_ru, for sums of at most `terms` products.
[[nodiscard]] constexpr double raise_factor(std::size_t terms) noexcept {
  return 1.0 + static_cast<double>(terms + 4) * 0x1p-51;
}

/// Returns an upper bound of s = Σ aᵢbᵢ from its floating-point value f.
///
/// Requires  at most `terms` < 2^40 products, factor = raise_factor(terms), aᵢ, bᵢ ≥ 0; f computed
///           by one multiplication a term and any order of additions, in any rounding mode; some
///           of both may be fused.
/// Ensures   s ≤ result. An overflow gives +∞, an invalid operation NaN: no comparison holds then.
/// Rounding  With u = 2^-52 (any mode) a product is a·b(1+δ) + η, |δ| ≤ u, |η| ≤ 2^-1074, and a sum
///           (a+b)(1+δ) without η, since sums of doubles that small are exact. A term passes at
///           most `terms` roundings, so f ≥ s(1−u)^t − t·2^-1074 and s ≤ (f + t·2^-1074)(1 + 2tu).
///           The factor is 1 + 2(t+4)u, exact; the two roundings here cost (1−u)² and 2^-1074, for
///           which 8u and the addend 2^-1000 are more than enough.
[[nodiscard]] constexpr double raise_ru(double f, double factor) noexcept {
  return f * factor + 0x1p-1000;
}

}  // namespace regulus
