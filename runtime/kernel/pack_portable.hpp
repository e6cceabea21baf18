// SPDX-License-Identifier: Apache-2.0
// Packs for any processor: operations to nearest, then outward, on four pairs of lanes.
//
// Rounding  to nearest (MXCSR or its like), no flush to zero. Sound with any optimisation that
//           keeps IEEE arithmetic, since no bound depends on a rounding mode that the compiler may
//           not know.
#pragma once

#include "runtime/kernel/pack_portable_pair.hpp"
#include "runtime/kernel/simd.hpp"

namespace regulus::pack {
inline namespace portable {

inline constexpr unsigned kRounding = 0;  // REGULUS_ROUND_NEAREST

struct V {
  simd::V2 a, b, c, d;
};
struct M {
  simd::M2 a, b, c, d;
};

REGULUS_INLINE V splat(double x) {
  const simd::V2 two = pair::splat(x);
  return {two, two, two, two};
}

#define REGULUS_ON_PAIRS_1(result, name, argument, function)             \
  REGULUS_INLINE result name(argument x) {                               \
    return {function(x.a), function(x.b), function(x.c), function(x.d)}; \
  }
#define REGULUS_ON_PAIRS_2(result, name, argument, function)                                 \
  REGULUS_INLINE result name(argument x, argument y) {                                       \
    return {function(x.a, y.a), function(x.b, y.b), function(x.c, y.c), function(x.d, y.d)}; \
  }

REGULUS_ON_PAIRS_1(V, operator-, V, pair::negate)
REGULUS_ON_PAIRS_2(V, min, V, pair::min)
REGULUS_ON_PAIRS_2(V, max, V, pair::max)
REGULUS_ON_PAIRS_2(V, add_rd, V, pair::add_rd)
REGULUS_ON_PAIRS_2(V, add_ru, V, pair::add_ru)
REGULUS_ON_PAIRS_2(V, mul_rd, V, pair::mul_rd)
REGULUS_ON_PAIRS_2(V, mul_ru, V, pair::mul_ru)
/// mul_rd for factors that are not negative: the result is not negative either.
REGULUS_ON_PAIRS_2(V, mul_rd_nonnegative, V, pair::mul_rd_nonnegative)
REGULUS_ON_PAIRS_2(V, div_rd, V, pair::div_rd)
REGULUS_ON_PAIRS_2(V, div_ru, V, pair::div_ru)
// For doubles whose result is a double.
REGULUS_ON_PAIRS_2(V, add_exact, V, pair::add_exact)
REGULUS_ON_PAIRS_2(V, mul_exact, V, pair::mul_exact)
REGULUS_ON_PAIRS_1(V, sqrt_rd, V, pair::sqrt_rd)
REGULUS_ON_PAIRS_1(V, sqrt_ru, V, pair::sqrt_ru)
REGULUS_ON_PAIRS_1(M, negative, V, pair::negative)
REGULUS_ON_PAIRS_2(M, operator<, V, pair::less)
REGULUS_ON_PAIRS_2(M, operator<=, V, pair::less_equal)
REGULUS_ON_PAIRS_2(M, operator&, M, pair::both)
REGULUS_ON_PAIRS_2(M, operator|, M, pair::either)
REGULUS_ON_PAIRS_1(M, operator~, M, pair::opposite)

#undef REGULUS_ON_PAIRS_1
#undef REGULUS_ON_PAIRS_2

REGULUS_INLINE V select(M m, V x, V y) {
  return {pair::select(m.a, x.a, y.a), pair::select(m.b, x.b, y.b), pair::select(m.c, x.c, y.c),
          pair::select(m.d, x.d, y.d)};
}
REGULUS_INLINE unsigned bits(M m) {
  return pair::bits(m.a) | pair::bits(m.b) << 2 | pair::bits(m.c) << 4 | pair::bits(m.d) << 6;
}

REGULUS_INLINE V fma_exact(V x, V y, V z) { return add_exact(mul_exact(x, y), z); }
REGULUS_INLINE V sub_rd(V x, V y) { return add_rd(x, -y); }
REGULUS_INLINE V sub_ru(V x, V y) { return add_ru(x, -y); }
REGULUS_INLINE V fma_rd(V x, V y, V z) { return add_rd(mul_rd(x, y), z); }
REGULUS_INLINE V fma_ru(V x, V y, V z) { return add_ru(mul_ru(x, y), z); }

REGULUS_INLINE simd::V2 row_part(const double* rows, int start) {
  return *reinterpret_cast<const simd::V2InMemory*>(rows + start);
}
REGULUS_INLINE void store_row_part(double* rows, int start, simd::V2 two) {
  *reinterpret_cast<simd::V2InMemory*>(rows + start) = two;
}
REGULUS_INLINE V row(const double* rows, int index) {
  const int i = simd::kLanes * index;
  return {row_part(rows, i), row_part(rows, i + 2), row_part(rows, i + 4), row_part(rows, i + 6)};
}
REGULUS_INLINE void store_row(double* rows, int index, V x) {
  const int i = simd::kLanes * index;
  store_row_part(rows, i, x.a);
  store_row_part(rows, i + 2, x.b);
  store_row_part(rows, i + 4, x.c);
  store_row_part(rows, i + 6, x.d);
}

}  // namespace portable
}  // namespace regulus::pack

// An operation has some hundred instructions. If they were inlined, a compiler would need half a
// minute for a kernel of 1500 operations, and the kernel would gain little.
#define REGULUS_PACK_OPERATION static inline __attribute__((noinline))
#define REGULUS_PACK_ISA portable
#include "runtime/kernel/pack_lo_hi.hpp"
