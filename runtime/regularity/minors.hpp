// SPDX-License-Identifier: Apache-2.0
// Determinants of eight interval matrices at once, by expansion into minors.
#pragma once

#include "runtime/interval/type.hpp"
#include "runtime/regularity/lanes.hpp"
#include "runtime/regularity/views.hpp"

namespace regulus::detail {

/// The largest order that is expanded for eight lanes; larger ones are not enclosed.
inline constexpr std::size_t kMaxEightMinors = 8;

/// An interval for each lane.
struct LaneIntervals {
  Interval of[kLanes];

  [[nodiscard]] Interval& operator[](std::size_t lane) noexcept { return of[lane]; }
  [[nodiscard]] const Interval& operator[](std::size_t lane) const noexcept { return of[lane]; }
};

/// Encloses eight determinants by expansion along the rows in the order of their mean widths, the
/// narrowest outermost, and also along the columns. The result is the intersection.
///
/// A minor is a set of columns of the first rows and is computed once: n·2^(n−1) products. The
/// paper's recursion, which searches for the narrowest line of each minor again, takes n!.
///
/// Shape     matrix n×n, 1 ≤ n.
/// Ensures   det(A) ∈ result[lane] for every real A between the bounds of a lane; [−∞, ∞] where
///           n > kMaxEightMinors or bounds are too large.
/// Rounding  bounds to nearest, then outward by a bound of the whole error, see the source.
/// Source    Merlet, T-RO 2007, §III-A.
[[nodiscard]] LaneIntervals enclose_determinants(ConstIntervalMatrix matrix) noexcept;

}  // namespace regulus::detail
