// SPDX-License-Identifier: Apache-2.0
// sin, cos and tan of a bound, then of an interval.
//
// Claim     for |x| ≤ 2^20 the computed sin x and cos x miss the exact value by less than the
//           distance to the next double on either side: one step outward is a bound. tan: two.
// Argument  beside each function. tests/property/interval/error_bound_test.cpp re-proves the bounds
//           of sin_cos_parts and tan_point by interval error analysis of this very code over all
//           reduced arguments, the polynomials by Arb; reduction_test.cpp measures reduce.
// Test      tests/property/interval/elementary_test.cpp, containment against Arb.
// Test      tests/property/interval/elementary_test.cpp, containment against Arb.
#pragma once

#include "runtime/interval/elementary/exact.hpp"
#include "runtime/interval/elementary/outward.hpp"

namespace regulus::detail::elementary {
inline namespace REGULUS_LANES_ISA {

inline constexpr double kReductionLimit = 0x1p20;

// π/2 = C₁ + C₂ + C₃ + C₄ + δ, |δ| < 2^-159. C₁ C₂ C₃ have 33 bits, of weights 2^0…2^-32,
// 2^-33…2^-65, 2^-66…2^-98: their products with an integer below 2^20 are exact.
inline constexpr double kHalfPi1 = 0x1.921fb544p+0;
inline constexpr double kHalfPi2 = 0x1.0b4611a6p-34;
inline constexpr double kHalfPi3 = 0x1.3198a2ep-69;
inline constexpr double kHalfPi4 = 0x1.b839a252049c1p-104;
inline constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;

/// 1.5·2^52: adding it rounds to an integer, which is then in the low bits of the sum.
inline constexpr double kToInteger = 0x1.8p52;

/// (sin r / r − 1)/r² and (cos r − 1 + r²/2)/r⁴ as polynomials in r², for |r| ≤ 0.7854. Relative to
/// the function they err by less than 2^-57.9 and 2^-63.
inline constexpr double kSinCoefficients[] = {-0x1.5555555555549p-3,  0x1.111111110f8a5p-7,
                                              -0x1.a01a019c15ec9p-13, 0x1.71de357b097a6p-19,
                                              -0x1.ae5e68aea6b5p-26,  0x1.5d93b2d678123p-33};
inline constexpr double kCosCoefficients[] = {0x1.555555555554cp-5,  -0x1.6c16c16c15225p-10,
                                              0x1.a01a019cc0708p-16, -0x1.27e4f813ba8f5p-22,
                                              0x1.1ee9f228b05p-29,   -0x1.8fb1b2a51e651p-37};

/// x = k·π/2 + r.
template <class T>
struct QuarterTurns {
  Parts<T> r;     ///< |r| < π/4 + 2^-30
  Bits<T> k;      ///< + a multiple of 4 that is the same for every x
  Mask<T> valid;  ///< |x| ≤ kReductionLimit; elsewhere r and k are meaningless
};

/// Ensures   where valid: |x − k·π/2 − (r.high + r.low)| < 2^-69·|r|, |r.low| ≤ 2^-52·|r.high| or
///           ≤ 2^-83; r.high is 0 only for x = 0 and has the sign of r.
///
/// |k| < 2^20 since 2^20·2/π < 0.64·2^20. x − k·C₁ is exact: either k = 0, or |x| ≥ 1/2 and it is a
/// multiple of 2^-53 below 1. The two TwoSums are exact. What is left is
///  - the sum of their low parts and k·C₄: each low part is ≤ 2^-53 of its high part, so the three
///    roundings stay below 2^-98·|r| while |h₂| ≥ 2^-46. If |h₂| is smaller, then |h₁| < 2^-45,
///    both differences were exact (multiples of 2^-98) and the low parts are 0;
///  - k·C₄ rounded (2^-83·2^-53) and k·δ (2^-139): below 2^-134. No double but 0 comes closer to a
///    multiple of π/2 than 2^-62 (Muller et al., Handbook of Floating-Point Arithmetic, 2nd ed.,
///    §10.2), so this is below 2^-72·|r|.
/// Each TwoSum leaves at most half an ulp of its high part, and the two high parts agree but for
/// 2^-49; when |h₂| is so small that this matters, only k·C₄ is left, and |h₂| > 2^-63.
template <class T>
inline QuarterTurns<T> reduce(T x) noexcept {
  const T shifted = x * splat<T>(kTwoOverPi) + splat<T>(kToInteger);
  const T k = shifted - splat<T>(kToInteger);
  const Parts<T> h1 = two_sum(x - k * splat<T>(kHalfPi1), -(k * splat<T>(kHalfPi2)));
  const Parts<T> h2 = two_sum(h1.high, -(k * splat<T>(kHalfPi3)));
  const T low = (h1.low + h2.low) - k * splat<T>(kHalfPi4);
  const Mask<T> valid = ~less(splat<T>(kReductionLimit), magnitude(x)) & equal(x, x);
  return {{h2.high, low}, to_bits(shifted), valid};
}

template <class T>
struct SinCosParts {
  Parts<T> sin;
  Parts<T> cos;
};

/// sin(r) and cos(r) as high + low.
///
/// Requires  |r.high| ≤ 0.7854, r.low as reduce leaves it.
/// Ensures   |high + low − f(r)| < half the distance from the nearest double of high + low to
///           either neighbour of it: rounded once more, it is one step from a bound.
///
/// With z = r², u = 2^-53, |r| = π/4 (the worst place; errors are absolute):
///   sin: low = r·z·P(z) is −0.079, four roundings 4u·0.079; r.low·(1 − z/2) replaces r.low·cos r,
///        which errs by r.low·z²/24 < 2^-58; adding the two, u·0.079; the polynomial 2^-58·0.71.
///        Sum 0.44u, where half the distance is u/2 (sin in [1/2, 1)). Below, low shrinks as r³.
///   cos: 1 − z/2 is exact with its remainder but for the rounding of z, u/4; z²·Q(z) is 0.016,
///        four roundings 0.064u; r·r.low for sin(r)·r.low errs by r³/6·r.low < 0.08u. Sum below
///        0.42u, where half the distance is u/2.
template <class T>
inline SinCosParts<T> sin_cos_parts(Parts<T> r) noexcept {
  const T z = r.high * r.high;
  const T half_z = z * splat<T>(0.5);
  const Parts<T> cos_head = fast_two_sum(splat<T>(1), -half_z);
  const T sin_tail = r.high * (z * polynomial(z, kSinCoefficients)) + r.low * cos_head.high;
  const T cos_tail = (z * z) * polynomial(z, kCosCoefficients) - r.high * r.low;
  return {{r.high, sin_tail}, {cos_head.high, cos_head.low + cos_tail}};
}

/// The values at the ends of an interval.
template <class T>
struct SinCosPoint {
  T sin;            ///< nearly nearest; 0 iff x is 0
  T cos;            ///< nearly nearest; never 0
  Bits<T> quarter;  ///< ⌊x/(π/2)⌋, + a multiple of 4 that is the same for every x
  Mask<T> valid;
};

/// −x in the lanes where bit 1 of k is set.
template <class T>
inline T negate_if_half_turn(T x, Bits<T> k) noexcept {
  return from_bits(to_bits(x) ^ ((k & 2) << 62));
}

template <class T>
inline SinCosPoint<T> sin_cos_point(T x) noexcept {
  const QuarterTurns<T> turns = reduce(x);
  const SinCosParts<T> parts = sin_cos_parts(turns.r);
  const T sin_r = parts.sin.high + parts.sin.low;
  const T cos_r = parts.cos.high + parts.cos.low;
  const Mask<T> odd = differ(turns.k & 1, Bits<T>{});
  const Mask<T> below = less(turns.r.high, splat<T>(0));
  return {negate_if_half_turn(select(odd, cos_r, sin_r), turns.k),
          negate_if_half_turn(select(odd, sin_r, cos_r), turns.k + 1), turns.k + (Bits<T>)below,
          turns.valid};
}

/// Is there an n ≡ −shift (mod 4) with a < n·π/2 ≤ b? Extrema at a itself need no treatment: the
/// value at a is one of them.
template <class T>
inline Mask<T> passes(const SinCosPoint<T>& a, const SinCosPoint<T>& b, unsigned shift) noexcept {
  return differ((a.quarter + shift) >> 2, (b.quarter + shift) >> 2);
}

/// Returns bounds from the values at the ends, and from the extrema that lie between them.
template <class T>
inline Bounds<T> wave_bounds(T at_lo, T at_hi, Mask<T> has_minimum, Mask<T> has_maximum) noexcept {
  const T one = splat<T>(1);
  const T lo = larger(step_down_unless_zero(smaller(at_lo, at_hi)), -one);
  const T hi = smaller(step_up_unless_zero(larger(at_lo, at_hi)), one);
  return {select(has_minimum, -one, lo), select(has_maximum, one, hi)};
}

template <class T>
struct SinCosBounds {
  Bounds<T> sin;
  Bounds<T> cos;
};

/// Ensures   both enclosures, 2 ulp; [−1, 1] where a bound is beyond the reduction limit.
template <class T>
[[gnu::always_inline]] inline SinCosBounds<T> sin_cos_bounds(Bounds<T> x) noexcept {
  const SinCosPoint<T> a = sin_cos_point(x.lo);
  const SinCosPoint<T> b = sin_cos_point(x.hi);
  const Mask<T> invalid = ~(a.valid & b.valid);
  const Bounds<T> sin = wave_bounds(a.sin, b.sin, passes(a, b, 1) | invalid,  //
                                    passes(a, b, 3) | invalid);
  Bounds<T> cos = wave_bounds(a.cos, b.cos, passes(a, b, 2) | invalid, passes(a, b, 0) | invalid);
  const Mask<T> zero = equal(x.lo, splat<T>(0)) & equal(x.hi, splat<T>(0));
  cos.lo = select(zero, splat<T>(1), cos.lo);
  return {sin, cos};
}

/// num/den rounded once, of unevaluated sums.
///
/// Requires  |num.low| ≤ |num.high|/2, |den.low| ≤ |den.high|/2, |num/den| < 2^100, den = 1 or
///           |num| > 2^-100.
/// Ensures   the relative error before the last rounding is below 2^-100 + that of num and den.
///
/// TwoProduct is exact: no part underflows, unless den = 1 where each is 0 or exact.
template <class T>
inline T quotient(Parts<T> num, Parts<T> den) noexcept {
  const Parts<T> n = fast_two_sum(num.high, num.low);
  const Parts<T> d = fast_two_sum(den.high, den.low);
  const T q = n.high / d.high;
  const Parts<T> back = two_product(q, d.high);
  const T remainder = ((n.high - back.high) - back.low) + (n.low - q * d.low);
  return q + remainder / d.high;
}

/// The greatest distance, in steps, of the nearly nearest tangent from a bound.
inline constexpr int kTanSteps = 2;

/// tan(r) if k is even, −1/tan(r) if it is odd: tan(k·π/2 + r).
template <class T>
inline T tan_point(const QuarterTurns<T>& turns) noexcept {
  const SinCosParts<T> parts = sin_cos_parts(turns.r);
  const Mask<T> odd = differ(turns.k & 1, Bits<T>{});
  const Parts<T> num{select(odd, -parts.cos.high, parts.sin.high),
                     select(odd, -parts.cos.low, parts.sin.low)};
  const Parts<T> den{select(odd, parts.sin.high, parts.cos.high),
                     select(odd, parts.sin.low, parts.cos.low)};
  return quotient(num, den);
}

/// Ensures   tight within 4 ulp. Undefined where cos x = 0 and beyond the reduction limit.
template <class T>
inline Partial<T> tan_bounds(Bounds<T> x) noexcept {
  const QuarterTurns<T> a = reduce(x.lo);
  const QuarterTurns<T> b = reduce(x.hi);
  const auto half_turn = [](const QuarterTurns<T>& turns) {
    const Mask<T> below = less(turns.r.high, splat<T>(0));
    return (turns.k + (Bits<T>)below + 1) >> 1;
  };
  const T at_lo = tan_point(a);
  const T at_hi = tan_point(b);
  const T zero = splat<T>(0);
  return {{select(equal(x.lo, zero), zero, steps_down<kTanSteps>(at_lo)),
           select(equal(x.hi, zero), zero, steps_up<kTanSteps>(at_hi))},
          ~(a.valid & b.valid) | differ(half_turn(a), half_turn(b))};
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::elementary
