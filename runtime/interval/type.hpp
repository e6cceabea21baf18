// SPDX-License-Identifier: Apache-2.0
// The interval type, tests of it, and the set operations that need no rounding.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime/interval/rounding.hpp"

namespace regulus {

/// The closed set of the reals x with lo ≤ x ≤ hi.
///
/// Ensures   lo ≤ hi, lo < +∞, hi > −∞, no NaN. Any other arguments (a NaN, bounds in the wrong
///           order, an infinite point) give [−∞, ∞]: construction never shrinks a set.
struct Interval {
  double lo = 0;
  double hi = 0;

  constexpr Interval() noexcept = default;
  /// The double itself, exactly. A decimal such as 0.1 names a double that is not 1/10.
  constexpr Interval(double point) noexcept : Interval(point, point) {}
  constexpr Interval(double lower, double upper) noexcept {
    const bool valid = lower <= upper && lower < kInfinity && upper > -kInfinity;
    lo = valid ? lower : -kInfinity;
    hi = valid ? upper : kInfinity;
  }

  friend constexpr bool operator==(const Interval&, const Interval&) = default;
};

inline constexpr Interval kEntire{-kInfinity, kInfinity};
inline constexpr Interval kPi{0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1};

// Tests. certain_: true for all points; possibly_: true for some.

[[nodiscard]] constexpr bool is_thin(Interval x) noexcept { return x.lo == x.hi; }
[[nodiscard]] constexpr bool is_bounded(Interval x) noexcept {
  return -kInfinity < x.lo && x.hi < kInfinity;
}
[[nodiscard]] constexpr bool contains(Interval x, double point) noexcept {
  return x.lo <= point && point <= x.hi;
}
[[nodiscard]] constexpr bool contains_zero(Interval x) noexcept { return contains(x, 0); }
[[nodiscard]] constexpr bool certain_subset(Interval inner, Interval outer) noexcept {
  return outer.lo <= inner.lo && inner.hi <= outer.hi;
}
[[nodiscard]] constexpr bool certain_disjoint(Interval x, Interval y) noexcept {
  return x.hi < y.lo || y.hi < x.lo;
}

[[nodiscard]] constexpr bool certain_less(Interval x, Interval y) noexcept { return x.hi < y.lo; }
[[nodiscard]] constexpr bool certain_less_equal(Interval x, Interval y) noexcept {
  return x.hi <= y.lo;
}
[[nodiscard]] constexpr bool possibly_less(Interval x, Interval y) noexcept { return x.lo < y.hi; }
[[nodiscard]] constexpr bool possibly_less_equal(Interval x, Interval y) noexcept {
  return x.lo <= y.hi;
}

[[nodiscard]] constexpr bool certain_positive(Interval x) noexcept { return x.lo > 0; }
[[nodiscard]] constexpr bool certain_negative(Interval x) noexcept { return x.hi < 0; }
[[nodiscard]] constexpr bool certain_nonnegative(Interval x) noexcept { return x.lo >= 0; }
[[nodiscard]] constexpr bool certain_nonpositive(Interval x) noexcept { return x.hi <= 0; }
[[nodiscard]] constexpr bool possibly_positive(Interval x) noexcept { return x.hi > 0; }
[[nodiscard]] constexpr bool possibly_negative(Interval x) noexcept { return x.lo < 0; }

// Sets.

[[nodiscard]] constexpr Interval hull(Interval x, Interval y) noexcept {
  return {std::min(x.lo, y.lo), std::max(x.hi, y.hi)};
}

/// Ensures   the common points; nullopt iff there are none.
[[nodiscard]] constexpr std::optional<Interval> intersect(Interval x, Interval y) noexcept {
  if (certain_disjoint(x, y)) return std::nullopt;
  return Interval{std::max(x.lo, y.lo), std::min(x.hi, y.hi)};
}

// Magnitudes and sizes.

/// The largest |x|, exactly.
[[nodiscard]] constexpr double mag(Interval x) noexcept { return std::max(-x.lo, x.hi); }
/// The smallest |x|, exactly.
[[nodiscard]] constexpr double mig(Interval x) noexcept {
  return contains_zero(x) ? 0 : std::max(x.lo, -x.hi);
}

/// Ensures   a finite point of x. Rounding: near the middle; nothing better is promised.
[[nodiscard]] inline double mid(Interval x) noexcept {
  if (x == kEntire) return 0;
  if (x.lo == -kInfinity) return -kMaxDouble;
  if (x.hi == kInfinity) return kMaxDouble;
  return std::clamp(x.lo / 2 + x.hi / 2, x.lo, x.hi);
}

/// Ensures   x ⊆ [mid(x) − rad_ru(x), mid(x) + rad_ru(x)]. Rounding: up.
[[nodiscard]] inline double rad_ru(Interval x) noexcept {
  const double m = mid(x);
  return std::max(sub_ru(x.hi, m), sub_ru(m, x.lo));
}

[[nodiscard]] inline double width_ru(Interval x) noexcept { return sub_ru(x.hi, x.lo); }

struct Halves {
  Interval left;
  Interval right;
};

/// Ensures   left ∪ right = x, both strictly narrower; nullopt iff no double lies strictly between.
[[nodiscard]] inline std::optional<Halves> bisect(Interval x) noexcept {
  const double m = mid(x);
  if (!(x.lo < m && m < x.hi)) return std::nullopt;
  return Halves{{x.lo, m}, {m, x.hi}};
}

}  // namespace regulus
