// SPDX-License-Identifier: Apache-2.0
// Arithmetic on intervals.
//
// Requires  MXCSR at nearest (runtime/interval/rounding.hpp).
// Ensures   z ∈ result for the exact z of the operation on any points of the arguments. + − · / sqr
//           sqrt abs are tight: the narrowest such interval of doubles.
//
// An operation that is not defined everywhere has two forms. f(x, undefined) sets `undefined` when
// some point of the argument is outside the domain, and then returns [−∞, ∞]; it never clears it.
// f(x) returns [−∞, ∞] there without a report.
#pragma once

#include "runtime/interval/type.hpp"

namespace regulus {

[[nodiscard]] constexpr Interval operator-(Interval x) noexcept { return {-x.hi, -x.lo}; }

[[nodiscard]] inline Interval operator+(Interval x, Interval y) noexcept {
  return {add_rd(x.lo, y.lo), add_ru(x.hi, y.hi)};
}

[[nodiscard]] inline Interval operator-(Interval x, Interval y) noexcept {
  return {sub_rd(x.lo, y.hi), sub_ru(x.hi, y.lo)};
}

[[nodiscard]] inline Interval operator*(Interval x, Interval y) noexcept {
  if (x.lo >= 0) {
    if (y.lo >= 0) return {mul_rd(x.lo, y.lo), mul_ru(x.hi, y.hi)};
    if (y.hi <= 0) return {mul_rd(x.hi, y.lo), mul_ru(x.lo, y.hi)};
    return {mul_rd(x.hi, y.lo), mul_ru(x.hi, y.hi)};
  }
  if (x.hi <= 0) return -(-x * y);
  if (y.lo >= 0 || y.hi <= 0) return y * x;
  return {std::min(mul_rd(x.lo, y.hi), mul_rd(x.hi, y.lo)),
          std::max(mul_ru(x.lo, y.lo), mul_ru(x.hi, y.hi))};
}

/// Undefined where y = 0.
[[nodiscard]] inline Interval div(Interval x, Interval y, bool& undefined) noexcept {
  if (contains_zero(y)) {
    undefined = true;
    return kEntire;
  }
  if (y.hi < 0) return div(-x, -y, undefined);
  if (x.lo < 0 && x.hi <= 0) return -div(-x, y, undefined);
  return {div_rd(x.lo, x.lo >= 0 ? y.hi : y.lo), div_ru(x.hi, y.lo)};
}

[[nodiscard]] inline Interval operator/(Interval x, Interval y) noexcept {
  bool undefined = false;
  return div(x, y, undefined);
}

inline Interval& operator+=(Interval& x, Interval y) noexcept { return x = x + y; }
inline Interval& operator-=(Interval& x, Interval y) noexcept { return x = x - y; }
inline Interval& operator*=(Interval& x, Interval y) noexcept { return x = x * y; }
inline Interval& operator/=(Interval& x, Interval y) noexcept { return x = x / y; }

[[nodiscard]] constexpr Interval abs(Interval x) noexcept { return {mig(x), mag(x)}; }

[[nodiscard]] inline Interval sqr(Interval x) noexcept {
  const double least = mig(x);
  const double largest = mag(x);
  return {mul_rd(least, least), mul_ru(largest, largest)};
}

/// Undefined where x < 0.
[[nodiscard]] inline Interval sqrt(Interval x, bool& undefined) noexcept {
  if (x.lo < 0) {
    undefined = true;
    return kEntire;
  }
  return {sqrt_rd(x.lo), sqrt_ru(x.hi)};
}

[[nodiscard]] inline Interval sqrt(Interval x) noexcept {
  bool undefined = false;
  return sqrt(x, undefined);
}

/// Returns 2^e·x for any e. It is exact except for overflow and underflow, where a bound moves
/// outward to the next double.
[[nodiscard]] Interval times_power_of_two(Interval x, int e) noexcept;

/// Returns xⁿ for any n; x⁰ = 1. Undefined where x = 0 if n < 0. Tight for |n| ≤ 1 and n = 2.
/// Otherwise each multiplication of binary powering rounds outward, and so does the quotient of a
/// negative power. None of these overflows or underflows: only the result may.
[[nodiscard]] Interval pow(Interval x, int n, bool& undefined) noexcept;
[[nodiscard]] Interval pow(Interval x, int n) noexcept;

}  // namespace regulus
