// SPDX-License-Identifier: Apache-2.0
// Directed bounds of one operation, computed with rounding to nearest. The sign of the exact error
// of the nearest result shows if this result is the bound, or if its neighbour is.
//
// Requires  MXCSR at nearest, FTZ and DAZ off (runtime/interval/floating_point_scope.hpp), for
//           everything in this header.
// Rounding  _rd: the largest double ≤ the exact value; _ru: the smallest ≥ it. Over the whole range
//           of doubles, subnormal and overflowing results included.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace regulus {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kMaxDouble = std::numeric_limits<double>::max();
inline constexpr double kMinSubnormal = std::numeric_limits<double>::denorm_min();

/// The least double > x; +∞ for +∞ and NaN for NaN.
[[nodiscard]] inline double next_up(double x) noexcept {
  if (x != x || x == kInfinity) return x;
  if (x == 0) return kMinSubnormal;
  const auto bits = std::bit_cast<std::int64_t>(x);
  return std::bit_cast<double>(bits < 0 ? bits - 1 : bits + 1);
}

/// The greatest double < x; −∞ for −∞ and NaN for NaN.
[[nodiscard]] inline double next_down(double x) noexcept { return -next_up(-x); }

/// Doubles with the sign of (exact result − nearest result). If the nearest result or an operand is
/// infinite, they are NaN or have either sign.
namespace residual {

inline constexpr double kTwo300 = 0x1p300;
inline constexpr double kTwo600 = 0x1p600;

/// Ensures   the exact error of s = a + b.
/// Source    Dekker 1971 (FastTwoSum). Sums do not underflow inexactly, and with |a| ≥ |b| the
///           difference s − a cannot overflow when s does not.
[[nodiscard]] inline double of_sum(double a, double b, double s) noexcept {
  const bool ordered = std::fabs(a) >= std::fabs(b);
  const double larger = ordered ? a : b;
  const double smaller = ordered ? b : a;
  return smaller - (s - larger);
}

/// Ensures   the sign of a·b − p, for p = a·b.
///
/// std::fma rounds a·b − p once, so the sign is right unless that underflows to 0. a·b − p is a
/// multiple of ulp(a)·ulp(b) ≥ |a·b|·2^-106, which is ≥ 2^-1074 when |p| ≥ 2^-960. Below, |a| and
/// |b| are < 2^115 (the other one is ≥ 2^-1074), so scaling each by 2^600 is exact, and then
/// ulp(a)·ulp(b) ≥ 2^-474·2^-474.
[[nodiscard]] inline double of_product(double a, double b, double p) noexcept {
  if (std::fabs(p) >= 0x1p-960) return std::fma(a, b, -p);
  return std::fma(a * kTwo600, b * kTwo600, -(p * kTwo600) * kTwo600);
}

/// Ensures   the sign of (a/b − q), for q = a/b, b finite and not 0.
///
/// Its sign is that of a − q·b, exact but for one rounding: right unless that underflows. a − q·b
/// is a multiple of ulp(a) ≥ |a|·2^-53 or of ulp(q)·ulp(b). The latter is ≥ |q·b|·2^-106 ≥
/// |a|·2^-107 for q normal. For q subnormal or 0, |b| ≥ |a|·2^1021, so it is ≥ 2^-1074·|a|·2^968.
/// All are ≥ 2^-1074 for |a| ≥ 2^-500; for smaller ones, |a| ≥ 2^-1074 still, they are after
/// scaling by 2^600. There |q·b| < 2^-499, so that the smaller factor is < 2^-249 and can be the
/// one to scale.
[[nodiscard]] inline double of_quotient(double a, double b, double q) noexcept {
  double remainder;
  if (std::fabs(a) >= 0x1p-500)
    remainder = std::fma(-q, b, a);
  else if (std::fabs(q) < std::fabs(b))
    remainder = std::fma(-(q * kTwo600), b, a * kTwo600);
  else
    remainder = std::fma(-q, b * kTwo600, a * kTwo600);
  return b > 0 ? remainder : -remainder;
}

/// Ensures   the sign of √x − s, for s = √x, x ≥ 0.
///
/// It is that of x − s², a multiple of x·2^-106; scaled as above where this is below 2^-1074.
[[nodiscard]] inline double of_sqrt(double x, double s) noexcept {
  if (x >= 0x1p-900) return std::fma(-s, s, x);
  return std::fma(-(s * kTwo300), s * kTwo300, x * kTwo600);
}

/// A residual that is NaN counts as either sign: the bound then moves outward by one step.
[[nodiscard]] inline double round_down(double nearest, double error) noexcept {
  return error >= 0 ? nearest : next_down(nearest);
}
[[nodiscard]] inline double round_up(double nearest, double error) noexcept {
  return error <= 0 ? nearest : next_up(nearest);
}

}  // namespace residual

// An infinite operand means the limit of finite ones. An infinite result of finite operands is an
// overflow: its inner bound is ±kMaxDouble.

[[nodiscard]] inline double add_rd(double a, double b) noexcept {
  const double s = a + b;
  return residual::round_down(s, residual::of_sum(a, b, s));
}
[[nodiscard]] inline double add_ru(double a, double b) noexcept {
  const double s = a + b;
  return residual::round_up(s, residual::of_sum(a, b, s));
}
[[nodiscard]] inline double sub_rd(double a, double b) noexcept { return add_rd(a, -b); }
[[nodiscard]] inline double sub_ru(double a, double b) noexcept { return add_ru(a, -b); }

/// Ensures   0·∞ = 0: a bound 0 times an unbounded end of a set contributes 0.
[[nodiscard]] inline double mul_rd(double a, double b) noexcept {
  if (a == 0 || b == 0) return 0;
  const double p = a * b;
  return residual::round_down(p, residual::of_product(a, b, p));
}
[[nodiscard]] inline double mul_ru(double a, double b) noexcept { return -mul_rd(-a, b); }

/// Requires  b ≠ 0; a and b not both infinite.
[[nodiscard]] inline double div_rd(double a, double b) noexcept {
  if (a == 0 || std::fabs(b) == kInfinity) return 0;
  const double q = a / b;
  return residual::round_down(q, residual::of_quotient(a, b, q));
}
[[nodiscard]] inline double div_ru(double a, double b) noexcept { return -div_rd(-a, b); }

/// Requires  x ≥ 0. The square root instruction rounds correctly; no library is called.
[[nodiscard]] inline double sqrt_rd(double x) noexcept {
  if (x == 0 || x == kInfinity) return x;
  const double s = std::sqrt(x);
  return residual::round_down(s, residual::of_sqrt(x, s));
}
[[nodiscard]] inline double sqrt_ru(double x) noexcept {
  if (x == 0 || x == kInfinity) return x;
  const double s = std::sqrt(x);
  return residual::round_up(s, residual::of_sqrt(x, s));
}

}  // namespace regulus
