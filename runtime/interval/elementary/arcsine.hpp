// SPDX-License-Identifier: Apache-2.0
// asin and acos of bounds and of intervals.
//
// Claim     one step outward of the nearly nearest value encloses the function.
// Argument  beside arcsine_of_magnitude. tests/property/interval/error_bound_test.cpp re-proves the
//           claim by interval error analysis of this code, the polynomial by Arb.
// Test      tests/property/interval/elementary_test.cpp, containment against Arb.
#pragma once

#include "runtime/interval/elementary/arctangent.hpp"

namespace regulus::detail::elementary {
inline namespace REGULUS_LANES_ISA {

/// (asin s / s − 1)/s² as a polynomial in s², for |s| ≤ 1/2: relative error of asin below 2^-59.
inline constexpr double kAsinCoefficients[] = {
    0x1.5555555555578p-3, 0x1.333333332df3bp-4, 0x1.6db6db7227b95p-5, 0x1.f1c71a8d9a20bp-6,
    0x1.6e8bdfa09636dp-6, 0x1.1c49e3b51aa12p-6, 0x1.ca20ac1d621dep-7, 0x1.757cd394e28d8p-7,
    0x1.616b37a41d9bbp-7, 0x1.e35070d13515cp-9, 0x1.646300edd7f41p-6, -0x1.590d6a0bdd6bep-6,
    0x1.0b994be972bf4p-5};

/// asin of a number in [0, 1/2], as high + low, from which asin and acos are assembled.
template <class T>
struct HalfAngle {
  Parts<T> asin;   ///< of |x| itself, or of √((1 − |x|)/2) = sin of half of acos |x|
  Mask<T> halved;  ///< |x| > 1/2
};

/// Requires  0 ≤ x ≤ 1.
///
/// z is either x² rounded or (1 − x)/2 exact; its error matters only in s·z·R(z). In the second
/// case √z = s + s_low, s_low = (z − s²)/2s with the exact s²; s_low²/2s and s_low·z·R(z) < 2^-59
/// are dropped. The tail is ≤ 0.024 with four roundings below 0.1·2^-53.
template <class T>
inline HalfAngle<T> arcsine_of_magnitude(T x) noexcept {
  const Mask<T> halved = less(splat<T>(0.5), x);
  const T z = select(halved, (splat<T>(1) - x) * splat<T>(0.5), x * x);
  const T root = square_root(z);
  const Parts<T> square = two_product(root, root);
  const T divisor = select(equal(root, splat<T>(0)), splat<T>(1), root + root);
  const T root_low = ((z - square.high) - square.low) / divisor;
  const T s = select(halved, root, x);
  const T s_low = select(halved, root_low, splat<T>(0));
  return {{s, s * (z * polynomial(z, kAsinCoefficients)) + s_low}, halved};
}

/// Returns base + factor·angle, rounded once at the end.
///
/// Requires  |factor| = 1 or 2; base = 0 or ≥ |factor·angle|.
template <class T>
inline T assemble(Parts<T> base, T factor, Parts<T> angle) noexcept {
  const Parts<T> head = fast_two_sum(base.high, factor * angle.high);
  return head.high + (head.low + (base.low + factor * angle.low));
}

template <class T>
inline Parts<T> half_pi_where(Mask<T> mask) noexcept {
  return {select(mask, splat<T>(kHalfPiHigh), splat<T>(0)),
          select(mask, splat<T>(kHalfPiLow), splat<T>(0))};
}

/// asin x = asin x, or π/2 − 2·asin √((1 − x)/2), with the sign of x. 0 iff x is 0.
///
/// Before the last rounding the error is at most 2·0.1·2^-53 + 2^-57 where asin x > 1/2, that is
/// less than half the distance 2^-53; for |x| ≤ 1/2 it shrinks as x³.
template <class T>
inline T asin_point(T x) noexcept {
  const HalfAngle<T> half = arcsine_of_magnitude(magnitude(x));
  const T factor = select(half.halved, splat<T>(-2), splat<T>(1));
  return with_sign_of(assemble(half_pi_where<T>(half.halved), factor, half.asin), x);
}

/// acos x = π/2 − asin x; 2·asin √((1 − x)/2) for x > 1/2; π − 2·asin √((1 + x)/2) for x < −1/2.
/// 0 iff x is 1.
///
/// The second is relatively as accurate as asin of a number ≤ 1/2; the others exceed π/3 and have
/// the absolute error of asin.
template <class T>
inline T acos_point(T x) noexcept {
  const HalfAngle<T> half = arcsine_of_magnitude(magnitude(x));
  const Mask<T> negative = less(x, splat<T>(0));
  const T toward = select(negative, splat<T>(1), splat<T>(-1));
  const T factor = select(half.halved, toward * splat<T>(-2), toward);
  const Mask<T> far = half.halved & negative;
  const Parts<T> quarter = half_pi_where<T>(~half.halved | far);
  const T doubled = select(far, splat<T>(2), splat<T>(1));
  return assemble({quarter.high * doubled, quarter.low * doubled}, factor, half.asin);
}

template <class T>
inline Mask<T> leaves_unit(Bounds<T> x) noexcept {
  return less(x.lo, splat<T>(-1)) | less(splat<T>(1), x.hi);
}
template <class T>
inline Bounds<T> clamp_to_unit(Bounds<T> x) noexcept {
  const T one = splat<T>(1);
  return {smaller(larger(x.lo, -one), one), smaller(larger(x.hi, -one), one)};
}

/// Ensures   tight within 2 ulp. Undefined where |x| > 1.
template <class T>
inline Partial<T> asin_bounds(Bounds<T> x) noexcept {
  const Bounds<T> inside = clamp_to_unit(x);
  return {
      {step_down_unless_zero(asin_point(inside.lo)), step_up_unless_zero(asin_point(inside.hi))},
      leaves_unit(x)};
}
template <class T>
inline Partial<T> acos_bounds(Bounds<T> x) noexcept {
  const Bounds<T> inside = clamp_to_unit(x);
  return {
      {step_down_unless_zero(acos_point(inside.hi)), step_up_unless_zero(acos_point(inside.lo))},
      leaves_unit(x)};
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::elementary
