// SPDX-License-Identifier: Apache-2.0
// exp and log of bounds and of intervals.
//
// Claim     one step outward of the nearly nearest value encloses the function; where exp is below
//           2^-1022, a step before and one after it is scaled.
// Argument  beside exp_parts and log_parts; tests/property/interval/error_bound_test.cpp re-proves
//           both by interval error analysis of this code, the polynomials against Arb.
// Test      tests/property/interval/elementary_test.cpp, containment against Arb.
#pragma once

#include "runtime/interval/elementary/exact.hpp"
#include "runtime/interval/elementary/outward.hpp"

namespace regulus::detail::elementary {
inline namespace REGULUS_LANES_ISA {

// log 2 = high + low + δ, |δ| < 2^-102; high has 42 bits: its product with |k| < 2^11 is exact.
inline constexpr double kLog2High = 0x1.62e42fefa38p-1;
inline constexpr double kLog2Low = 0x1.ef35793c7673p-45;
inline constexpr double kLog2E = 0x1.71547652b82fep+0;

/// 1.5·2^52, see trigonometric.hpp.
inline constexpr double kExpToInteger = 0x1.8p52;
inline constexpr std::uint64_t kExpToIntegerBits = 0x4338000000000000;

/// Outside [kExpLeast, kExpMost] exp underflows to below the least, overflows the greatest double.
inline constexpr double kExpLeast = -746;
inline constexpr double kExpMost = 710;

/// (e^r − 1 − r)/r² as a polynomial in r, for |r| ≤ 0.34658: error of e^r below 2^-57.6.
inline constexpr double kExpCoefficients[] = {
    0x1.000000000000cp-1,  0x1.555555555555bp-3,  0x1.555555554fe06p-5,  0x1.111111110ec8ep-7,
    0x1.6c16c18603f81p-10, 0x1.a01a01b3b1d5fp-13, 0x1.a01995c55fdf1p-16, 0x1.71ddef48cf6acp-19,
    0x1.28b0eaf1ea09bp-22, 0x1.af6dac6d12e42p-26};

/// e^r as high + low.
///
/// Requires  |r.high| ≤ 0.34658, r.high nearest to r.high + r.low.
/// Ensures   |high + low − e^r| < half the distance from the nearest double of high + low to either
///           neighbour of it.
///
/// The worst place is r = −0.347, where e^r = 0.707 and half the distance is 2^-54. r²·Q(r) = 0.054
/// has three roundings, and Q one of 1.3·2^-53: 0.36·2^-54; adding the low part 2^-58; r.low·(1 +
/// r) for r.low·e^r errs by 2^-55·r²/2; the polynomial by 0.09·2^-54.
template <class T>
inline Parts<T> exp_parts(Parts<T> r) noexcept {
  const Parts<T> head = fast_two_sum(splat<T>(1), r.high);
  const T tail = (r.high * r.high) * polynomial(r.high, kExpCoefficients);
  return {head.high, tail + (head.low + r.low * head.high)};
}

/// 2^k for −1022 ≤ k ≤ 1023, k in two's complement.
template <class T>
inline T power_of_two(Bits<T> k) noexcept {
  return from_bits((k + 1023) << 52);
}

/// e^x = m·2^k: one step outward of m encloses it.
template <class T>
struct ExpPoint {
  T mantissa;  ///< nearly nearest, in [0.7, 1.42]
  T scale;     ///< scale·rest = 2^k, each a normal double
  T rest;
};

/// Requires  kExpLeast ≤ x ≤ kExpMost.
///
/// |k| ≤ 1077, so k·high is exact, and so is x − k·high: for k ≠ 0 both are multiples of 2^-54, and
/// their difference is below 1/2. k·low errs by 2^-34-53, and k·δ by 2^-91, which is negligible
/// against 2^-54.
template <class T>
inline ExpPoint<T> exp_point(T x) noexcept {
  const T shifted = x * splat<T>(kLog2E) + splat<T>(kExpToInteger);
  const T k = shifted - splat<T>(kExpToInteger);
  const Parts<T> r = two_sum(x - k * splat<T>(kLog2High), -(k * splat<T>(kLog2Low)));
  const Parts<T> parts = exp_parts(r);
  const Bits<T> k_bits = to_bits(shifted) - kExpToIntegerBits;
  const Bits<T> half = ((k_bits + 4096) >> 1) - 2048;
  return {parts.high + parts.low, power_of_two<T>(half), power_of_two<T>(k_bits - half)};
}

/// Scaling by powers of two is exact above 2^-1022. Below it rounds, possibly up to 2^-1022 itself,
/// by at most half a distance: one step more restores the bound.
template <class T>
inline T scale_down(T mantissa_lo, const ExpPoint<T>& at) noexcept {
  const T nearest = mantissa_lo * at.scale * at.rest;
  const T positive = larger(step_down(nearest), splat<T>(0));
  return smaller(select(less(splat<T>(0x1p-1022), nearest), nearest, positive),
                 splat<T>(0x1.fffffffffffffp+1023));
}
template <class T>
inline T scale_up(T mantissa_hi, const ExpPoint<T>& at) noexcept {
  const T nearest = mantissa_hi * at.scale * at.rest;
  return select(less(splat<T>(0x1p-1022), nearest), nearest, step_up(nearest));
}

/// Ensures   tight within 2 ulp, 3 below 2^-1022. Infinite bounds allowed.
template <class T>
inline Bounds<T> exp_bounds(Bounds<T> x) noexcept {
  const auto clamp = [](T t) {
    return smaller(larger(t, splat<T>(kExpLeast)), splat<T>(kExpMost));
  };
  const ExpPoint<T> a = exp_point(clamp(x.lo));
  const ExpPoint<T> b = exp_point(clamp(x.hi));
  const T one = splat<T>(1);
  const T zero = splat<T>(0);
  return {select(equal(x.lo, zero), one, scale_down(step_down(a.mantissa), a)),
          select(equal(x.hi, zero), one, scale_up(step_up(b.mantissa), b))};
}

/// (log((1 + s)/(1 − s))/s − 2)/s² as a polynomial in s², for |s| ≤ 0.1852: relative error of
/// 2s·(…) below 2^-57.
inline constexpr double kLogCoefficients[] = {
    0x1.555555555560bp-1, 0x1.9999999957eaap-2, 0x1.24924964d0bbfp-2, 0x1.c71c364113b9fp-3,
    0x1.746bce82d972dp-3, 0x1.39163d526c378p-3, 0x1.3458250f99f1ap-3};

/// log(2^k·(1 + f)) as high + low.
///
/// Requires  −5/16 ≤ f < 3/8, k an integer, |k| ≤ 1100.
/// Ensures   |high + low − log| < half the distance from the nearest double of high + low to either
///           neighbour of it; both are 0 for k = 0, f = 0.
///
/// log(1 + f) = f − (h − s·(h + R)), h = f²/2, s = f/(2 + f). The worst places are f = 3/8 and f =
/// −5/16 with k = 0 or ±1, where |log| > 1/4 and half the distance is 2^-55. In that unit: h 0.25;
/// s·(h + R) = 0.014 with 4.5 roundings 0.25; the sums 0.25 and 0.13; the polynomial 0.08. Smaller
/// |f| lets the error fall as f², |k| ≥ 2 makes the result larger than 1.
template <class T>
inline Parts<T> log_parts(T k, T f) noexcept {
  const T s = f / (splat<T>(2) + f);
  const T z = s * s;
  const T h = (f * splat<T>(0.5)) * f;
  const T correction = s * (h + z * polynomial(z, kLogCoefficients)) + k * splat<T>(kLog2Low);
  const Parts<T> head = fast_two_sum(k * splat<T>(kLog2High), f);
  return {head.high, head.low - (h - correction)};
}

/// Nearly nearest. Requires x > 0, finite. 0 iff x is 1.
///
/// x = 2^k·m with m in [11/16, 11/8): m − 1 is exact (Sterbenz).
template <class T>
inline T log_point(T x) noexcept {
  constexpr std::uint64_t kLeastMantissa = 0x3fe6000000000000;  // 11/16
  constexpr std::uint64_t kExponentField = 0xfff0000000000000;
  const Mask<T> subnormal = less(x, splat<T>(0x1p-1022));
  const T normal = select(subnormal, x * splat<T>(0x1p54), x);
  const Bits<T> offset = to_bits(normal) - kLeastMantissa;
  const T m = from_bits(to_bits(normal) - (offset & kExponentField));
  // k + 1024 ≥ 0; added to the bits of 2^52 it makes the double 2^52 + k + 1024.
  const Bits<T> biased = (offset + (std::uint64_t{1024} << 52)) >> 52;
  const T k = from_bits(biased + 0x4330000000000000) - splat<T>(0x1p52 + 1024);
  const Parts<T> parts = log_parts(select(subnormal, k - splat<T>(54), k), m - splat<T>(1));
  return parts.high + parts.low;
}

/// Ensures   tight within 2 ulp; x.hi = ∞ allowed. Undefined where x ≤ 0.
template <class T>
inline Partial<T> log_bounds(Bounds<T> x) noexcept {
  const T hi = step_up_unless_zero(log_point(x.hi));
  const Mask<T> unbounded = less(splat<T>(0x1.fffffffffffffp+1023), x.hi);
  return {{step_down_unless_zero(log_point(x.lo)), select(unbounded, x.hi, hi)},
          ~less(splat<T>(0), x.lo)};
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::elementary
