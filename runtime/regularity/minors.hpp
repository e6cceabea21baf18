// SPDX-License-Identifier: Apache-2.0
// Determinants of eight interval matrices at once, by expansion into minors.
#pragma once

#include "regulus/regularity/lanes.hpp"

namespace regulus {

/// The largest order that is expanded for eight lanes; larger ones are not enclosed.
inline constexpr std::size_t kMaxEightMinors = 8;

/// Encloses eight determinants by expansion along the rows in the order of their mean widths, the
/// narrowest outermost, and along the columns likewise; the result is in both enclosures.
///
/// A minor is a set of columns of the rows so far and is computed once: n·2^(n−1) products where
/// the paper's recursion, which looks for the narrowest line of each minor anew, takes n!.
///
/// Shape     matrix n×n in interval layout; lower and upper: one double a lane.
/// Requires  1 ≤ n.
/// Ensures   det(A) ∈ [lower, upper] for every real A between the bounds of a lane; −∞ and ∞ where
///           n > kMaxEightMinors or bounds are too large.
/// Rounding  bounds to nearest, then outward by a bound of the whole error, see the source.
/// Source    Merlet, T-RO 2007, §III-A.
void enclose_determinants(const double* matrix, std::size_t n, double* lower,
                          double* upper) noexcept;

}  // namespace regulus
