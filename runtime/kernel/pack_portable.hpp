// SPDX-License-Identifier: Apache-2.0
// Packs for any processor: operations to nearest, then outward. The vectors are the compiler's; it
// splits them into what the processor has.
//
// Rounding  MXCSR (or its like) to nearest, no flush to zero. Sound with any optimisation that
// keeps
//           IEEE arithmetic, since no bound depends on a rounding mode the compiler may not know.
// Source    the step: Rump, Zimmermann, Boldo, Melquiond, "Computing predecessor and successor in
//           rounding to nearest", BIT 49 (2009), Algorithm 1; the error of a sum: Knuth, TAOCP
//           2, 4.2.2.
#pragma once

#include "regulus/kernel/simd.hpp"

namespace regulus::pack {
inline namespace portable {

using V = simd::V8;
using M = simd::M8;

inline constexpr unsigned kRounding = 0;  // REGULUS_ROUND_NEAREST

REGULUS_INLINE V splat(double c) { return V{c, c, c, c, c, c, c, c}; }
REGULUS_INLINE V min(V a, V b) { return a < b ? a : b; }
REGULUS_INLINE V max(V a, V b) { return a > b ? a : b; }
REGULUS_INLINE M negative(V x) { return x < splat(0.0); }
REGULUS_INLINE V magnitude(V x) {
  return reinterpret_cast<V>(reinterpret_cast<M>(x) & simd::kMagnitudeBits);
}

REGULUS_INLINE unsigned bits(M m) {
  unsigned result = 0;
  for (int lane = 0; lane < 8; ++lane) result |= static_cast<unsigned>(m[lane] & 1) << lane;
  return result;
}

/// At least the distance from x to its neighbours: fl(fl(φ|x|) + η), φ = 2⁻⁵³(1 + 2⁻⁵²), η =
/// 2⁻¹⁰⁷⁴.
REGULUS_INLINE V step(V x) {
  return magnitude(x) * splat(0x1.0000000000001p-53) + splat(simd::kMinSubnormal);
}

/// At most the double before x; with x = fl(v), at most v. Overflow of v to +∞ gives a finite
/// bound.
REGULUS_INLINE V below(V x) {
  const V finite_above = min(x, splat(simd::kMaxDouble));
  return finite_above - step(finite_above);
}

/// At least the double after x; with x = fl(v), at least v.
REGULUS_INLINE V above(V x) {
  const V finite_below = max(x, splat(-simd::kMaxDouble));
  return finite_below + step(finite_below);
}

/// a + b − fl(a + b), exact when it is finite (an overflow on the way makes it ±∞ or NaN).
REGULUS_INLINE V error_of_sum(V a, V b, V sum) {
  const V from_b = sum - a;
  return (a - (sum - from_b)) + (b - from_b);
}

REGULUS_INLINE V add_rd(V a, V b) {
  const V sum = a + b;
  const V error = error_of_sum(a, b, sum);
  return ((error >= splat(0.0)) & (error < splat(simd::kInfinity))) ? sum : below(sum);
}
REGULUS_INLINE V add_ru(V a, V b) {
  const V sum = a + b;
  const V error = error_of_sum(a, b, sum);
  return ((error <= splat(0.0)) & (error > splat(-simd::kInfinity))) ? sum : above(sum);
}
REGULUS_INLINE V sub_rd(V a, V b) { return add_rd(a, -b); }
REGULUS_INLINE V sub_ru(V a, V b) { return add_ru(a, -b); }

// A product with a zero factor is exact; keeping it spreads no noise through sparse matrices.
REGULUS_INLINE M zero_factor(V a, V b) { return (a == splat(0.0)) | (b == splat(0.0)); }
REGULUS_INLINE V mul_rd(V a, V b) {
  const V product = a * b;
  return zero_factor(a, b) ? product : below(product);
}
REGULUS_INLINE V mul_ru(V a, V b) {
  const V product = a * b;
  return zero_factor(a, b) ? product : above(product);
}
/// mul_rd for factors that are not negative: neither is the result.
REGULUS_INLINE V mul_rd_nonnegative(V a, V b) { return max(mul_rd(a, b), splat(0.0)); }

REGULUS_INLINE V fma_rd(V a, V b, V c) { return add_rd(mul_rd(a, b), c); }
REGULUS_INLINE V fma_ru(V a, V b, V c) { return add_ru(mul_ru(a, b), c); }

REGULUS_INLINE V div_rd(V a, V b) {
  const V quotient = a / b;
  return a == splat(0.0) ? quotient : below(quotient);
}
REGULUS_INLINE V div_ru(V a, V b) {
  const V quotient = a / b;
  return a == splat(0.0) ? quotient : above(quotient);
}

REGULUS_INLINE V sqrt_nearest(V a) {
  V root = a;
  for (int lane = 0; lane < 8; ++lane) root[lane] = __builtin_sqrt(a[lane]);
  return root;
}
REGULUS_INLINE V sqrt_rd(V a) { return max(below(sqrt_nearest(a)), splat(0.0)); }
REGULUS_INLINE V sqrt_ru(V a) { return a == splat(0.0) ? a : above(sqrt_nearest(a)); }

}  // namespace portable
}  // namespace regulus::pack

#define REGULUS_PACK_ISA portable
#include "regulus/kernel/pack_lo_hi.hpp"
