// SPDX-License-Identifier: Apache-2.0
// The solutions t of a·t = s for enclosures of a and s.
#pragma once

#include <algorithm>

#include "runtime/verifier/interval.hpp"
#include "runtime/verifier/rounding.hpp"

namespace regulus::verifier {

/// Narrows t to the hull of its parts with a·t = s for some a ∈ A, s ∈ S; false: there are none.
///
/// Requires  S and A bounded.
[[nodiscard]] inline bool narrow_to_quotients(Interval S, Interval A, Interval& t) {
  if (contains(A, 0.0) && contains(S, 0.0)) return true;
  Interval all = everything();
  if (!contains(A, 0.0)) {
    all = S / A;
  } else {
    if (S.hi < 0.0) S = -S, A = -A;
    // s > 0: with a > 0 is t ≥ s/a, with a < 0 is t ≤ s/a.
    const double least = A.hi > 0.0 ? down(S.lo / A.hi) : kInfinity;
    const double most = A.lo < 0.0 ? up(S.lo / A.lo) : -kInfinity;
    const bool is_above = t.hi >= least, is_below = t.lo <= most;
    if (!is_above && !is_below) return false;
    if (!is_below) all.lo = least;
    if (!is_above) all.hi = most;
  }
  t = {std::max(t.lo, all.lo), std::min(t.hi, all.hi)};
  return t.lo <= t.hi;
}

}  // namespace regulus::verifier
