// SPDX-License-Identifier: Apache-2.0
// Four intervals as (−lo, hi) and four exact doubles: the arithmetic of one half of an AVX2 pack.
//
// All operands must be finite. min and max drop a NaN, so 0·∞ could hide an unbounded factor.
// Results that can overflow go through `checked`, which guarantees that no infinity comes here.
// Rounding  every + − * / and fma on vectors here is upward, by MXCSR.
#pragma once

#include "runtime/kernel/simd.hpp"

namespace regulus::pack {
inline namespace avx2 {

using V = simd::V4;
using M = simd::M4;
using simd::bits, simd::magnitude, simd::max, simd::min, simd::sign_select, simd::splat;

struct Half {
  V nlo, hi;
};

/// A value, and the lanes in which it is valid; the other lanes may contain anything.
struct Partial {
  M good;
  Half value;
};

REGULUS_INLINE Half negate(Half x) { return {x.hi, x.nlo}; }
REGULUS_INLINE Half add(Half x, Half y) { return {x.nlo + y.nlo, x.hi + y.hi}; }
REGULUS_INLINE Half add(Half x, V p) { return {x.nlo - p, x.hi + p}; }
REGULUS_INLINE Half add(V p, V q) { return {-p - q, p + q}; }
REGULUS_INLINE Half mul(V p, V q) { return {-p * q, p * q}; }

/// The bound of |a|·y that is −min(a·y), and the one that is max(a·y). For a < 0 they are
/// exchanged: −(a·y.hi) = |a|·y.hi and a·y.lo = |a|·(−y.lo). For a = ±0 either is correct.
REGULUS_INLINE V negated_least_factor(V a, Half y) { return sign_select(a, y.hi, y.nlo); }
REGULUS_INLINE V greatest_factor(V a, Half y) { return sign_select(a, y.nlo, y.hi); }

REGULUS_INLINE Half mul(V p, Half x) {
  const V size = magnitude(p);
  return {size * negated_least_factor(p, x), size * greatest_factor(p, x)};
}

/// Both extremes of x·y are at a bound of x, with the bound of y that fits its sign. x.nlo has the
/// opposite sign of the lower bound, which exchanges the two choices.
REGULUS_INLINE Half mul(Half x, Half y) {
  const V lo = magnitude(x.nlo), hi = magnitude(x.hi);
  return {max(lo * greatest_factor(x.nlo, y), hi * negated_least_factor(x.hi, y)),
          max(lo * negated_least_factor(x.nlo, y), hi * greatest_factor(x.hi, y))};
}

REGULUS_INLINE Half mul_add(V p, V q, Half z) {
  return {simd::fma(-p, q, z.nlo), simd::fma(p, q, z.hi)};
}
REGULUS_INLINE Half mul_add(V p, Half x, Half z) {
  const V size = magnitude(p);
  return {simd::fma(size, negated_least_factor(p, x), z.nlo),
          simd::fma(size, greatest_factor(p, x), z.hi)};
}
REGULUS_INLINE Half mul_add(Half x, Half y, Half z) {
  const V lo = magnitude(x.nlo), hi = magnitude(x.hi);
  return {max(simd::fma(lo, greatest_factor(x.nlo, y), z.nlo),
              simd::fma(hi, negated_least_factor(x.hi, y), z.nlo)),
          max(simd::fma(lo, negated_least_factor(x.nlo, y), z.hi),
              simd::fma(hi, greatest_factor(x.hi, y), z.hi))};
}

/// Minus the least absolute value, and the greatest: the bounds of |x| as they are stored.
REGULUS_INLINE Half abs(Half x) { return {min(min(x.nlo, x.hi), splat(0.0)), max(x.nlo, x.hi)}; }
REGULUS_INLINE Half sqr(Half x) {
  const Half a = abs(x);
  return {a.nlo * magnitude(a.nlo), a.hi * a.hi};
}

/// −aⁿ of a lower bound, given as na = −a ≤ 0, n ≥ 1; and aⁿ of an upper bound a ≥ 0. Every factor
/// is a bound of the same side, so the product is one.
REGULUS_INLINE V negated_power(V na, unsigned n) {
  const V a = magnitude(na);
  V r = na;
  for (int bit = 30 - __builtin_clz(n); bit >= 0; --bit) {
    r = r * magnitude(r);
    if ((n >> bit) & 1) r = r * a;
  }
  return r;
}
REGULUS_INLINE V power(V a, unsigned n) {
  V r = a;
  for (int bit = 30 - __builtin_clz(n); bit >= 0; --bit) {
    r = r * r;
    if ((n >> bit) & 1) r = r * a;
  }
  return r;
}

/// An upper bound of aⁿ, n odd: a·|a|ⁿ⁻¹, where a negative a needs the lower bound of |a|ⁿ⁻¹.
REGULUS_INLINE V odd_power(V a, unsigned n) {
  const V size = magnitude(a);
  return a * sign_select(a, magnitude(negated_power(-size, n - 1)), power(size, n - 1));
}

/// xⁿ, n ≥ 2. An odd power is monotone, and −(lo)ⁿ = (−lo)ⁿ.
REGULUS_INLINE Half pow(Half x, unsigned n) {
  if (n % 2 == 1) return {odd_power(x.nlo, n), odd_power(x.hi, n)};
  const Half a = abs(x);
  return {negated_power(a.nlo, n), power(a.hi, n)};
}

/// Returns true if −limit ≤ x ≤ limit; false for a NaN in either bound.
REGULUS_INLINE M within(Half x, double limit) {
  return (x.nlo <= splat(limit)) & (x.hi <= splat(limit));
}
REGULUS_INLINE Half zero_unless(M good, Half x) {
  return {good ? x.nlo : splat(0.0), good ? x.hi : splat(0.0)};
}

REGULUS_INLINE Partial checked(Half x) {
  return {within(x, simd::kMaxDouble) & (-x.nlo <= x.hi), x};
}

/// A negative divisor is made positive by changing both signs. Then the sign of the numerator
/// selects lo or hi of the divisor. An unusable divisor is replaced by 1, so that nothing is NaN.
REGULUS_INLINE Partial div(Half x, Half y) {
  const M flip = y.hi < splat(0.0);
  const M usable = flip | (y.nlo < splat(0.0));
  const V least = usable ? (flip ? -y.hi : -y.nlo) : splat(1.0);
  const V greatest = usable ? (flip ? y.nlo : y.hi) : splat(1.0);
  const V nlo = flip ? x.hi : x.nlo, hi = flip ? x.nlo : x.hi;
  const Half quotient = {nlo / sign_select(nlo, greatest, least),
                         hi / sign_select(hi, greatest, least)};
  return {usable & within(quotient, simd::kMaxMagnitude), quotient};
}

/// Returns √a rounded downward, a ≥ 0: the root rounded upward, or the double before it if its
/// square is more than a. The fma is exact in sign: rounding upward makes no positive number 0.
REGULUS_INLINE V sqrt_rd(V a) {
  const V root = simd::sqrt(a);
  const M above = simd::fma(root, root, -a) > splat(0.0);
  return reinterpret_cast<V>(reinterpret_cast<M>(root) + above);
}

// max returns its second operand if one is a NaN: it stays a NaN, and the lane is reported.
REGULUS_INLINE Partial sqrt(Half x) {
  const V lo = max(splat(0.0), -x.nlo), hi = max(splat(0.0), x.hi);
  const Half root = {-sqrt_rd(lo), simd::sqrt(hi)};
  return {(x.nlo <= splat(0.0)) & within(root, simd::kMaxMagnitude), root};
}

}  // namespace avx2
}  // namespace regulus::pack
