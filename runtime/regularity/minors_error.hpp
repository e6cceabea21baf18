// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "runtime/regularity/lanes.hpp"
#include "runtime/regularity/views.hpp"

namespace regulus::detail {

/// Returns mag of an interval; ∞ if a bound is NaN.
[[nodiscard]] inline double magnitude_of(double lo, double hi) noexcept {
  if (!(lo <= hi)) return std::numeric_limits<double>::infinity();
  return std::max(-lo, hi);
}

/// Returns a bound of the error from all roundings of a determinant together.
///
/// Requires  n ≤ 8; magnitude, n×n, bounds the entries; `permanent` ≥ that of the
///           magnitudes; a product of n entries is rounded at most `roundings` < 2^40 times; at
///           most 3·n·2^n·4 products underflow, each multiplied on by entries of other rows.
/// Ensures   ((1+u)^t − 1)·perm + 2^-1040·M^n ≤ result for u = 2^-52 and M = max(1, largest
///           magnitude): (1+u)^t − 1 ≤ 2tu, and 3·8·2^8·4·8!·2^-1074 ≤ 2^-1040. ∞ or NaN where
///           there is no bound.
/// Rounding  up.
[[nodiscard]] inline double minors_error_ru(ConstPointMatrix magnitude, std::size_t lane,
                                            double permanent, std::size_t roundings) noexcept {
  double largest = 1.0;
  for (std::size_t e = 0; e < magnitude.size(); ++e)
    largest = std::max(largest, magnitude.at(e, lane));
  double power = 0x1p-1040;
  for (std::size_t k = 0; k < magnitude.rows(); ++k)
    power = power * largest * (1.0 + 0x1p-50) + 0x1p-1074;
  return raise_ru(permanent * (static_cast<double>(roundings) * 0x1p-51) + power, raise_factor(3));
}

}  // namespace regulus::detail
