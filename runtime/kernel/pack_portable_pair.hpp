// SPDX-License-Identifier: Apache-2.0
// Rounded operations on two lanes. The only rounding mode is to nearest: each returns the result,
// or the double beyond it. Every 64-bit processor has a register for two doubles.
//
// Source  the step: Rump, Zimmermann, Boldo, Melquiond, "Computing predecessor and successor in
//         rounding to nearest", BIT 49 (2009), Algorithm 1; the error of a sum: Knuth, TAOCP 2,
//         4.2.2.
#pragma once

#include "runtime/kernel/simd.hpp"

namespace regulus::pack {
inline namespace portable {
namespace pair {

using simd::M2;
using simd::V2;

REGULUS_INLINE V2 splat(double c) { return V2{c, c}; }
// Like the processors' instructions, they return the second operand if either is a NaN.
REGULUS_INLINE V2 min(V2 a, V2 b) { return a < b ? a : b; }
REGULUS_INLINE V2 max(V2 a, V2 b) { return a > b ? a : b; }
REGULUS_INLINE V2 magnitude(V2 x) {
  return reinterpret_cast<V2>(reinterpret_cast<M2>(x) & simd::kMagnitudeBits);
}
REGULUS_INLINE V2 negate(V2 x) { return -x; }
REGULUS_INLINE V2 select(M2 m, V2 a, V2 b) { return m ? a : b; }
REGULUS_INLINE M2 negative(V2 x) { return x < splat(0.0); }

/// Returns at least the distance from x to its neighbours: fl(fl(φ|x|) + η), φ = 2⁻⁵³(1 + 2⁻⁵²), η
/// = 2⁻¹⁰⁷⁴.
REGULUS_INLINE V2 step(V2 x) {
  return magnitude(x) * splat(0x1.0000000000001p-53) + splat(simd::kMinSubnormal);
}

/// Returns at most the double before x; with x = fl(v), at most v. If v overflows to +∞, the bound
/// is finite.
REGULUS_INLINE V2 below(V2 x) {
  const V2 finite_above = min(splat(simd::kMaxDouble), x);
  return finite_above - step(finite_above);
}

/// Returns at least the double after x; with x = fl(v), at least v.
REGULUS_INLINE V2 above(V2 x) {
  const V2 finite_below = max(splat(-simd::kMaxDouble), x);
  return finite_below + step(finite_below);
}

REGULUS_INLINE V2 add_exact(V2 a, V2 b) { return a + b; }
REGULUS_INLINE V2 mul_exact(V2 a, V2 b) { return a * b; }

/// a + b − fl(a + b), exact when it is finite (an overflow on the way makes it ±∞ or NaN).
REGULUS_INLINE V2 error_of_sum(V2 a, V2 b, V2 sum) {
  const V2 from_b = sum - a;
  return (a - (sum - from_b)) + (b - from_b);
}

REGULUS_INLINE V2 add_rd(V2 a, V2 b) {
  const V2 sum = a + b;
  const V2 error = error_of_sum(a, b, sum);
  return ((error >= splat(0.0)) & (error < splat(simd::kInfinity))) ? sum : below(sum);
}
REGULUS_INLINE V2 add_ru(V2 a, V2 b) {
  const V2 sum = a + b;
  const V2 error = error_of_sum(a, b, sum);
  return ((error <= splat(0.0)) & (error > splat(-simd::kInfinity))) ? sum : above(sum);
}

// A product with a zero factor is exact. Keeping it exact keeps sparse matrices sparse.
REGULUS_INLINE M2 zero_factor(V2 a, V2 b) { return (a == splat(0.0)) | (b == splat(0.0)); }
REGULUS_INLINE V2 mul_rd(V2 a, V2 b) {
  const V2 product = a * b;
  return zero_factor(a, b) ? product : below(product);
}
REGULUS_INLINE V2 mul_ru(V2 a, V2 b) {
  const V2 product = a * b;
  return zero_factor(a, b) ? product : above(product);
}
REGULUS_INLINE V2 mul_rd_nonnegative(V2 a, V2 b) { return max(mul_rd(a, b), splat(0.0)); }

REGULUS_INLINE V2 div_rd(V2 a, V2 b) {
  const V2 quotient = a / b;
  return a == splat(0.0) ? quotient : below(quotient);
}
REGULUS_INLINE V2 div_ru(V2 a, V2 b) {
  const V2 quotient = a / b;
  return a == splat(0.0) ? quotient : above(quotient);
}

REGULUS_INLINE V2 sqrt_nearest(V2 a) { return V2{__builtin_sqrt(a[0]), __builtin_sqrt(a[1])}; }
REGULUS_INLINE V2 sqrt_rd(V2 a) { return max(below(sqrt_nearest(a)), splat(0.0)); }
REGULUS_INLINE V2 sqrt_ru(V2 a) { return a == splat(0.0) ? a : above(sqrt_nearest(a)); }

REGULUS_INLINE M2 less(V2 a, V2 b) { return a < b; }
REGULUS_INLINE M2 less_equal(V2 a, V2 b) { return a <= b; }
REGULUS_INLINE M2 both(M2 a, M2 b) { return a & b; }
REGULUS_INLINE M2 either(M2 a, M2 b) { return a | b; }
REGULUS_INLINE M2 opposite(M2 m) { return ~m; }
REGULUS_INLINE unsigned bits(M2 m) {
  return static_cast<unsigned>(m[0] & 1) | static_cast<unsigned>(m[1] & 2);
}

}  // namespace pair
}  // namespace portable
}  // namespace regulus::pack
