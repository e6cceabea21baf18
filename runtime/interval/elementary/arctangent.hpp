// SPDX-License-Identifier: Apache-2.0
// atan and atan2 of bounds and of intervals.
//
// Claim     atan: one step outward of the nearly nearest value encloses it; atan2: two steps.
// Argument  beside atan_parts and angle_of; tests/property/interval/error_bound_test.cpp re-proves
//           both by interval error analysis of this code, the polynomial against Arb.
// Test      tests/property/interval/elementary_test.cpp, containment against Arb.
#pragma once

#include "runtime/interval/elementary/exact.hpp"
#include "runtime/interval/elementary/outward.hpp"

namespace regulus::detail::elementary {
inline namespace REGULUS_LANES_ISA {

// High and low halves of constants: the sum is within 2^-108 of the number.
inline constexpr double kHalfPiHigh = 0x1.921fb54442d18p+0;
inline constexpr double kHalfPiLow = 0x1.1a62633145c07p-54;
inline constexpr double kPiHigh = 0x1.921fb54442d18p+1;
inline constexpr double kPiLow = 0x1.1a62633145c07p-53;

/// (atan t / t − 1)/t² as a polynomial in t², for |t| ≤ 7/16: relative error of atan below 2^-57.4.
inline constexpr double kAtanCoefficients[] = {
    -0x1.555555555550dp-2, 0x1.999999998ebd4p-3, -0x1.2492492008951p-3, 0x1.c71c6fe248f6cp-4,
    -0x1.745cdc569b42bp-4, 0x1.3b0f2b0e094f3p-4, -0x1.10d66ab742af5p-4, 0x1.dde2daaa8575cp-5,
    -0x1.97b4ba3f41128p-5, 0x1.2b442ff3e6883p-5, -0x1.0ad3353f342cbp-6};

/// atan t = atan c + atan((t − c)/(1 + c·t)) with c from {0, 1/2, 1, 3/2, ∞}.
template <class T>
struct AtanCentre {
  T c;     ///< 0 where c is ∞
  T high;  ///< atan c = high + low
  T low;
  Mask<T> infinite;
};

/// The centres change at 7/16, 11/16, 19/16 and 39/16, as in fdlibm.
template <class T>
inline AtanCentre<T> atan_centre(T t) noexcept {
  AtanCentre<T> centre{splat<T>(0), splat<T>(0), splat<T>(0), less(splat<T>(2.4375), t)};
  const auto from = [&](double start, double c, double high, double low) {
    const Mask<T> inside = ~less(t, splat<T>(start));
    centre.c = select(inside, splat<T>(c), centre.c);
    centre.high = select(inside, splat<T>(high), centre.high);
    centre.low = select(inside, splat<T>(low), centre.low);
  };
  from(0.4375, 0.5, 0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56);
  from(0.6875, 1.0, 0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55);
  from(1.1875, 1.5, 0x1.f730bd281f69bp-1, 0x1.007887af0cbbdp-56);
  centre.c = select(centre.infinite, splat<T>(0), centre.c);
  centre.high = select(centre.infinite, splat<T>(kHalfPiHigh), centre.high);
  centre.low = select(centre.infinite, splat<T>(kHalfPiLow), centre.low);
  return centre;
}

/// atan t as high + low.
///
/// Requires  t ≥ 0, ∞ allowed.
/// Ensures   |high + low − atan t| < half the distance from the nearest double of high + low to
///           either neighbour of it; both are 0 for t = 0.
///
/// t − c is exact (Sterbenz), so u has the relative error of the division, and of 1 + c·t: at most
/// 2.5·2^-53, 0 for c = 0. |u| ≤ 0.14, 0.19, 0.21 for the finite c > 0, each where atan t is at
/// least 2.6 times as large in ulp than u: the error of u stays below 0.6 of the half distance; so
/// it does for c = ∞, where |u| ≤ 0.41, atan t > 1 and only the division rounds. For c = 0 the tail
/// u³P(u²) ≤ 0.026 has four roundings: 0.4 of the half distance. The other tails are smaller, the
/// polynomial adds 0.09.
template <class T>
inline Parts<T> atan_parts(T t) noexcept {
  const AtanCentre<T> centre = atan_centre(t);
  const T num = select(centre.infinite, splat<T>(-1), t - centre.c);
  const T den = select(centre.infinite, t, splat<T>(1) + centre.c * t);
  const T u = num / den;
  const T z = u * u;
  const T tail = u * (z * polynomial(z, kAtanCoefficients));
  const Parts<T> head = fast_two_sum(centre.high, u);
  return {head.high, head.low + (centre.low + tail)};
}

/// Ensures   tight within 2 ulp; infinite bounds allowed.
template <class T>
inline Bounds<T> atan_bounds(Bounds<T> x) noexcept {
  const auto nearly = [](T t) {
    const Parts<T> parts = atan_parts(magnitude(t));
    return with_sign_of(parts.high + parts.low, t);
  };
  return {step_down_unless_zero(nearly(x.lo)), step_up_unless_zero(nearly(x.hi))};
}

/// The greatest distance, in steps, of the nearly nearest angle of a point from a bound.
inline constexpr int kAngleSteps = 2;

/// The angle of (x, y), x given by its magnitude and its sign, y ≥ 0: in [0, π].
///
/// Requires  |x|, y not both 0 and not both ∞.
/// Ensures   kAngleSteps outward enclose the angle. 0 for y = 0, x > 0.
///
/// With t = min/max ≤ 1 rounded, the angle is atan t, π/2 − atan t, π/2 + atan t or π − atan t. The
/// quotient adds 2^-53·t/(1 + t²) < 2^-53·atan t, at most the distance of the neighbours of atan t,
/// to the half distance of atan_parts: together below 1.5 distances, which is what two steps allow.
/// In the other cases the angle is ≥ π/4 and the error is the same in absolute terms. Where t is
/// subnormal its rounding errs by half a distance.
template <class T>
inline T angle_of(T x_magnitude, Mask<T> x_negative, T y) noexcept {
  const Mask<T> steep = less(x_magnitude, y);
  const T t = smaller(x_magnitude, y) / larger(x_magnitude, y);
  const Parts<T> part = atan_parts(t);
  // The base is 0, π/2 or π; atan t is subtracted when exactly one of the two swaps happened.
  const T base_high =
      select(steep, splat<T>(kHalfPiHigh), select(x_negative, splat<T>(kPiHigh), splat<T>(0)));
  const T base_low =
      select(steep, splat<T>(kHalfPiLow), select(x_negative, splat<T>(kPiLow), splat<T>(0)));
  const Mask<T> subtract = steep ^ x_negative;
  const T high = select(subtract, -part.high, part.high);
  const T low = select(subtract, -part.low, part.low);
  const Parts<T> head = fast_two_sum(base_high, high);
  return head.high + (head.low + (base_low + low));
}

/// The angle of the point (x, y), nearly nearest, in [−π, π].
template <class T>
inline T atan2_point(T y, T x) noexcept {
  const T angle = angle_of(magnitude(x), less(x, splat<T>(0)), magnitude(y));
  return with_sign_of(angle, y);
}

/// Ensures   tight within 4 ulp. Undefined where y = 0 and x ≤ 0.
///
/// Off the cut the angle is monotone along each side of the rectangle, so that the extremes are at
/// corners. The smallest angle: for y ≥ 0 it falls with x, for y < 0 it grows with x; at the x thus
/// chosen it grows with y if x ≥ 0 and falls otherwise. The largest angle mirrors that.
template <class T>
inline Partial<T> atan2_bounds(Bounds<T> y, Bounds<T> x) noexcept {
  const T zero = splat<T>(0);
  const T x_first = select(less(y.lo, zero), x.lo, x.hi);
  const T y_first = select(less(x_first, zero), y.hi, y.lo);
  const T x_last = select(less(y.hi, zero), x.hi, x.lo);
  const T y_last = select(less(x_last, zero), y.lo, y.hi);
  const T first = atan2_point(y_first, x_first);
  const T last = atan2_point(y_last, x_last);
  const Bounds<T> value{select(equal(y_first, zero), zero, steps_down<kAngleSteps>(first)),
                        select(equal(y_last, zero), zero, steps_up<kAngleSteps>(last))};
  const Mask<T> touches_cut = ~less(zero, x.lo) & ~less(zero, y.lo) & ~less(y.hi, zero);
  return {value, touches_cut};
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::elementary
