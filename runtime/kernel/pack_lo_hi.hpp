// SPDX-License-Identifier: Apache-2.0
// The operations of packs that keep their bounds as (lo, hi). They use the rounded operations on
// vectors (…_rd downward, …_ru upward) that the including header defines for its instruction set.
//
// All operands must be finite. min and max drop a NaN, so 0·∞ could hide an unbounded factor.
// Results that can overflow go through `checked`, which guarantees that no infinity comes here.
//
// The including header also defines REGULUS_PACK_OPERATION. It decides whether rounded operations
// are inlined into the kernel (a few instructions each) or called (a hundred instructions).
#pragma once

namespace regulus::pack {
inline namespace REGULUS_PACK_ISA {

/// Eight exact doubles.
struct P {
  V v;
  __attribute__((always_inline)) explicit P(double c) : v(splat(c)) {}
  __attribute__((always_inline)) explicit P(V values) : v(values) {}
};

/// Eight intervals.
struct I {
  V lo, hi;
};

REGULUS_INLINE I load(const double* boxes, int v) {
  return {row(boxes, 2 * v), row(boxes, 2 * v + 1)};
}
REGULUS_INLINE P point(const double* points, int p) { return P(row(points, p)); }
REGULUS_INLINE void store(double* out, int e, I x) {
  store_row(out, 2 * e, x.lo);
  store_row(out, 2 * e + 1, x.hi);
}
REGULUS_INLINE I constant(double lo, double hi) { return {splat(lo), splat(hi)}; }
REGULUS_INLINE I thin(P p) { return {p.v, p.v}; }
REGULUS_INLINE P point_of(I x) { return P(x.hi); }

REGULUS_INLINE I operator-(I x) { return {-x.hi, -x.lo}; }
REGULUS_PACK_OPERATION I operator+(I x, I y) { return {add_rd(x.lo, y.lo), add_ru(x.hi, y.hi)}; }
REGULUS_PACK_OPERATION I operator-(I x, I y) { return {sub_rd(x.lo, y.hi), sub_ru(x.hi, y.lo)}; }

REGULUS_INLINE P operator-(P p) { return P(-p.v); }
REGULUS_PACK_OPERATION I operator+(P p, P q) { return {add_rd(p.v, q.v), add_ru(p.v, q.v)}; }
REGULUS_PACK_OPERATION I operator-(P p, P q) { return {sub_rd(p.v, q.v), sub_ru(p.v, q.v)}; }
REGULUS_PACK_OPERATION I operator*(P p, P q) { return {mul_rd(p.v, q.v), mul_ru(p.v, q.v)}; }

REGULUS_INLINE P exact_add(P p, P q) { return P(add_exact(p.v, q.v)); }
REGULUS_INLINE P exact_sub(P p, P q) { return P(add_exact(p.v, -q.v)); }
REGULUS_INLINE P exact_mul(P p, P q) { return P(mul_exact(p.v, q.v)); }
REGULUS_INLINE P exact_mul_add(P p, P q, P r) { return P(fma_exact(p.v, q.v, r.v)); }

REGULUS_PACK_OPERATION I operator+(I x, P p) { return {add_rd(x.lo, p.v), add_ru(x.hi, p.v)}; }
REGULUS_INLINE I operator+(P p, I x) { return x + p; }
REGULUS_PACK_OPERATION I operator-(I x, P p) { return {sub_rd(x.lo, p.v), sub_ru(x.hi, p.v)}; }
REGULUS_PACK_OPERATION I operator-(P p, I x) { return {sub_rd(p.v, x.hi), sub_ru(p.v, x.lo)}; }

/// Returns the bound of y that makes a·y least, and the one that makes it greatest. For a = ±0
/// either is correct.
REGULUS_INLINE V least_factor(V a, I y) { return select(negative(a), y.hi, y.lo); }
REGULUS_INLINE V greatest_factor(V a, I y) { return select(negative(a), y.lo, y.hi); }

REGULUS_PACK_OPERATION I operator*(P p, I x) {
  return {mul_rd(p.v, least_factor(p.v, x)), mul_ru(p.v, greatest_factor(p.v, x))};
}
REGULUS_INLINE I operator*(I x, P p) { return p * x; }

/// min over y of x·y is concave in x and max is convex, so both extremes are at x.lo or x.hi. This
/// takes two products per bound instead of four. If the compiler knows the sign of x, the choice of
/// y costs nothing.
REGULUS_PACK_OPERATION I operator*(I x, I y) {
  return {min(mul_rd(x.lo, least_factor(x.lo, y)), mul_rd(x.hi, least_factor(x.hi, y))),
          max(mul_ru(x.lo, greatest_factor(x.lo, y)), mul_ru(x.hi, greatest_factor(x.hi, y)))};
}

REGULUS_PACK_OPERATION I mul_add(P p, P q, I z) {
  return {fma_rd(p.v, q.v, z.lo), fma_ru(p.v, q.v, z.hi)};
}
REGULUS_PACK_OPERATION I mul_add(P p, I x, I z) {
  return {fma_rd(p.v, least_factor(p.v, x), z.lo), fma_ru(p.v, greatest_factor(p.v, x), z.hi)};
}
REGULUS_INLINE I mul_add(I x, P p, I z) { return mul_add(p, x, z); }
REGULUS_PACK_OPERATION I mul_add(I x, I y, I z) {
  return {min(fma_rd(x.lo, least_factor(x.lo, y), z.lo), fma_rd(x.hi, least_factor(x.hi, y), z.lo)),
          max(fma_ru(x.lo, greatest_factor(x.lo, y), z.hi),
              fma_ru(x.hi, greatest_factor(x.hi, y), z.hi))};
}

/// Returns the least absolute value, or the greatest.
REGULUS_INLINE V mignitude(I x) { return max(max(x.lo, -x.hi), splat(0.0)); }
REGULUS_INLINE V magnitude(I x) { return max(-x.lo, x.hi); }

REGULUS_INLINE I abs(I x) { return {mignitude(x), magnitude(x)}; }
REGULUS_PACK_OPERATION I sqr(I x) {
  const I a = abs(x);
  return {mul_rd_nonnegative(a.lo, a.lo), mul_ru(a.hi, a.hi)};
}

/// Returns aⁿ, a ≥ 0, n ≥ 1. Every factor is a bound of the same side and not negative, so the
/// product is a bound of that side.
REGULUS_INLINE V power_rd(V a, unsigned n) {
  V r = a;
  for (int bit = 30 - __builtin_clz(n); bit >= 0; --bit) {
    r = mul_rd_nonnegative(r, r);
    if ((n >> bit) & 1) r = mul_rd_nonnegative(r, a);
  }
  return r;
}
REGULUS_INLINE V power_ru(V a, unsigned n) {
  V r = a;
  for (int bit = 30 - __builtin_clz(n); bit >= 0; --bit) {
    r = mul_ru(r, r);
    if ((n >> bit) & 1) r = mul_ru(r, a);
  }
  return r;
}

/// xⁿ, n ≥ 2. An odd power is monotone: aⁿ = a·|a|ⁿ⁻¹ at each bound, where a negative a needs the
/// other bound of |a|ⁿ⁻¹.
REGULUS_PACK_OPERATION I pow(I x, unsigned n) {
  const I a = abs(x);
  if (n % 2 == 0) return {power_rd(a.lo, n), power_ru(a.hi, n)};
  const V at_lo = max(x.lo, -x.lo), at_hi = max(x.hi, -x.hi);
  const V low = select(negative(x.lo), power_ru(at_lo, n - 1), power_rd(at_lo, n - 1));
  const V high = select(negative(x.hi), power_rd(at_hi, n - 1), power_ru(at_hi, n - 1));
  return {mul_rd(x.lo, low), mul_ru(x.hi, high)};
}

/// Returns x where `good`; otherwise 0, and sets the lane's bit.
REGULUS_INLINE I defined_where(M good, I x, unsigned& undefined) {
  undefined |= bits(~good);
  return {select(good, x.lo, splat(0.0)), select(good, x.hi, splat(0.0))};
}
/// Returns true if −limit ≤ x ≤ limit; false for a NaN in either bound.
REGULUS_INLINE M within(I x, double limit) {
  return (splat(-limit) <= x.lo) & (x.hi <= splat(limit));
}

REGULUS_PACK_OPERATION I checked(I x, unsigned& undefined) {
  return defined_where(within(x, simd::kMaxDouble) & (x.lo <= x.hi), x, undefined);
}

/// A negative divisor is made positive by changing both signs. Then the sign of the numerator
/// selects lo or hi of the divisor. An unusable divisor is replaced by 1, so that nothing traps or
/// is NaN.
REGULUS_PACK_OPERATION I div(I x, I y, unsigned& undefined) {
  const M flip = y.hi < splat(0.0);
  const M usable = flip | (splat(0.0) < y.lo);
  const I divisor = {select(usable, select(flip, -y.hi, y.lo), splat(1.0)),
                     select(usable, select(flip, -y.lo, y.hi), splat(1.0))};
  const I numerator = {select(flip, -x.hi, x.lo), select(flip, -x.lo, x.hi)};
  const I quotient = {div_rd(numerator.lo, greatest_factor(numerator.lo, divisor)),
                      div_ru(numerator.hi, least_factor(numerator.hi, divisor))};
  return defined_where(usable & within(quotient, simd::kMaxMagnitude), quotient, undefined);
}

// max returns its second operand if one is a NaN: it stays a NaN, and the lane is reported.
REGULUS_PACK_OPERATION I sqrt(I x, unsigned& undefined) {
  const M usable = splat(0.0) <= x.lo;
  const I root = {sqrt_rd(max(splat(0.0), x.lo)), sqrt_ru(max(splat(0.0), x.hi))};
  return defined_where(usable & within(root, simd::kMaxMagnitude), root, undefined);
}

}  // namespace REGULUS_PACK_ISA
}  // namespace regulus::pack

#include "runtime/kernel/pack_functions.hpp"
