// SPDX-License-Identifier: GPL-3.0-or-later
// Measures how far a bound lies outside the tight one, in doubles.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "runtime/interval/type.hpp"

namespace regulus::detail::test {

/// Returns the position of x in the order of doubles; −0 and +0 have the same position.
inline std::int64_t ordinal(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return bits < 0 ? std::numeric_limits<std::int64_t>::min() - bits : bits;
}

/// Ensures   the number of doubles from the tight bound to the given one, at the worse end.
/// Requires  tight ⊆ wide.
inline std::uint64_t excess_ulps(Interval wide, Interval tight) {
  const auto below =
      static_cast<std::uint64_t>(ordinal(tight.lo)) - static_cast<std::uint64_t>(ordinal(wide.lo));
  const auto above =
      static_cast<std::uint64_t>(ordinal(wide.hi)) - static_cast<std::uint64_t>(ordinal(tight.hi));
  return std::max(below, above);
}

}  // namespace regulus::detail::test
