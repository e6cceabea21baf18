// SPDX-License-Identifier: Apache-2.0
// Intervals of doubles, rounded to nearest and then stepped outward. The rounding mode must be to
// nearest; this is checked where verification starts.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace regulus::verifier {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Returns fl(φ|x| + η), φ = u(1 + 2u), u = 2^-53, η = 2^-1074; x plus it reaches the next double.
/// Source    Rump, Zimmermann, Boldo, Melquiond, BIT 49, 2009, Theorem 2.2, for every finite x.
inline double step_of(double x) noexcept {
  return std::fabs(x) * 0x1.0000000000001p-53 + 0x1p-1074;
}
/// If x is the double nearest to the exact result of an operation, that result lies between these
/// two. They are not finite if x is not.
inline double up(double x) noexcept { return x + step_of(x); }
inline double down(double x) noexcept { return x - step_of(x); }

struct Interval {
  double lo = 0, hi = 0;
};

inline Interval point(double x) noexcept { return {x, x}; }
inline Interval everything() noexcept { return {-kInfinity, kInfinity}; }

/// Returns false for NaN, too. An operation on bounded intervals may return one that is not bounded
/// (overflow). Code that stores a result checks it, so no NaN ever enters an operation.
inline bool is_bounded(Interval x) noexcept { return x.lo > -kInfinity && x.hi < kInfinity; }
inline bool contains(Interval x, double value) noexcept { return x.lo <= value && value <= x.hi; }
inline bool is_thin(Interval x) noexcept { return x.lo == x.hi; }
inline bool is_zero(Interval x) noexcept { return x.lo == 0.0 && x.hi == 0.0; }

inline Interval operator-(Interval x) noexcept { return {-x.hi, -x.lo}; }

// Zeros are exact: if a value does not depend on a variable, its derivative stays 0.
inline Interval operator+(Interval x, Interval y) noexcept {
  if (is_zero(x)) return y;
  if (is_zero(y)) return x;
  return {down(x.lo + y.lo), up(x.hi + y.hi)};
}
inline Interval operator-(Interval x, Interval y) noexcept { return x + -y; }

inline Interval operator*(Interval x, Interval y) noexcept {
  if (is_zero(x) || is_zero(y)) return {};
  const double a = x.lo * y.lo, b = x.lo * y.hi, c = x.hi * y.lo, d = x.hi * y.hi;
  return {down(std::min(std::min(a, b), std::min(c, d))),
          up(std::max(std::max(a, b), std::max(c, d)))};
}
inline Interval operator*(double k, Interval x) noexcept {
  if (k == 0.0 || is_zero(x)) return {};
  const double a = k * x.lo, b = k * x.hi;
  return k > 0 ? Interval{down(a), up(b)} : Interval{down(b), up(a)};
}

/// Returns all numbers if y contains 0.
inline Interval operator/(Interval x, Interval y) noexcept {
  if (contains(y, 0.0)) return everything();
  const double a = x.lo / y.lo, b = x.lo / y.hi, c = x.hi / y.lo, d = x.hi / y.hi;
  return {down(std::min(std::min(a, b), std::min(c, d))),
          up(std::max(std::max(a, b), std::max(c, d)))};
}

/// Returns max |x|, exact; ∞ if x is not bounded.
inline double mag(Interval x) noexcept { return is_bounded(x) ? std::max(-x.lo, x.hi) : kInfinity; }
/// Returns min |x|, exact.
inline double mig(Interval x) noexcept {
  return contains(x, 0.0) ? 0.0 : std::min(std::fabs(x.lo), std::fabs(x.hi));
}
/// Returns a double of x.
inline double mid(Interval x) noexcept { return std::clamp(0.5 * x.lo + 0.5 * x.hi, x.lo, x.hi); }
/// Returns an upper bound of the greatest distance from `middle` to a point of x.
inline double radius_ru(Interval x, double middle) noexcept {
  return is_thin(x) ? 0.0 : up(std::max(x.hi - middle, middle - x.lo));
}
inline Interval hull(Interval x, Interval y) noexcept {
  return {std::min(x.lo, y.lo), std::max(x.hi, y.hi)};
}

/// Requires  x.lo ≥ 0. IEEE 754 rounds square roots correctly.
inline Interval sqrt(Interval x) noexcept {
  return {std::max(0.0, down(std::sqrt(x.lo))), up(std::sqrt(x.hi))};
}

inline Interval square(Interval x) noexcept {
  const double least = mig(x), most = mag(x);
  return {std::max(0.0, down(least * least)), up(most * most)};
}

/// Returns x^n for n ≥ 1, by repeated squaring.
inline Interval power(Interval x, int n) noexcept {
  if (n == 1) return x;
  const Interval half = square(power(x, n / 2));
  return n % 2 == 0 ? half : half * x;
}

}  // namespace regulus::verifier
