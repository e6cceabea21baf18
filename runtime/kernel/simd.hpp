// SPDX-License-Identifier: Apache-2.0
// The vector types and the few instructions that packs use.
//
// Only compiler builtins are used: <immintrin.h> costs 210 ms of front end, and code compiled in
// process has no system header. If g++ and Clang name a builtin differently, there are two
// sections. Operations with an operator in the language use it: a + b under -frounding-math.
#pragma once

#include "runtime/kernel/abi.hpp"

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "fast-math breaks directed rounding: every bound would be unproved"
#endif

// Inlined even at -O0, with internal linkage. Two translation units of one program may be compiled
// for different instruction sets, and the linker must never replace the code of one by the other's.
#define REGULUS_INLINE static inline __attribute__((always_inline))

namespace regulus::simd {

using V8 = double __attribute__((vector_size(64)));
using M8 = long long __attribute__((vector_size(64)));  // a mask: all ones where true
using V4 = double __attribute__((vector_size(32)));
using M4 = long long __attribute__((vector_size(32)));
using V2 = double __attribute__((vector_size(16)));
using M2 = long long __attribute__((vector_size(16)));

// The same types for access to arrays of double.
using V8InMemory = double __attribute__((vector_size(64), may_alias));
using V4InMemory = double __attribute__((vector_size(32), may_alias));
using V2InMemory = double __attribute__((vector_size(16), may_alias));

inline constexpr int kLanes = REGULUS_LANES;
inline constexpr double kInfinity = __builtin_inf();
inline constexpr double kMaxDouble = __DBL_MAX__;
inline constexpr double kMinSubnormal = __DBL_DENORM_MIN__;
inline constexpr double kMaxMagnitude = 0x1p128;  // of results of partial operations
inline constexpr long long kMagnitudeBits = 0x7fffffffffffffff;

#if defined(REGULUS_ISA_AVX512)

enum { kDown = 9, kUp = 10, kNoRounding = 4 };  // toward −∞, +∞, without exceptions; not used

REGULUS_INLINE V8 splat(double c) { return V8{c, c, c, c, c, c, c, c}; }

#if defined(__clang__)
REGULUS_INLINE V8 add_rd(V8 a, V8 b) { return __builtin_ia32_addpd512(a, b, kDown); }
REGULUS_INLINE V8 add_ru(V8 a, V8 b) { return __builtin_ia32_addpd512(a, b, kUp); }
REGULUS_INLINE V8 sub_rd(V8 a, V8 b) { return __builtin_ia32_subpd512(a, b, kDown); }
REGULUS_INLINE V8 sub_ru(V8 a, V8 b) { return __builtin_ia32_subpd512(a, b, kUp); }
REGULUS_INLINE V8 mul_rd(V8 a, V8 b) { return __builtin_ia32_mulpd512(a, b, kDown); }
REGULUS_INLINE V8 mul_ru(V8 a, V8 b) { return __builtin_ia32_mulpd512(a, b, kUp); }
REGULUS_INLINE V8 div_rd(V8 a, V8 b) { return __builtin_ia32_divpd512(a, b, kDown); }
REGULUS_INLINE V8 div_ru(V8 a, V8 b) { return __builtin_ia32_divpd512(a, b, kUp); }
REGULUS_INLINE V8 sqrt_rd(V8 a) { return __builtin_ia32_sqrtpd512(a, kDown); }
REGULUS_INLINE V8 sqrt_ru(V8 a) { return __builtin_ia32_sqrtpd512(a, kUp); }
REGULUS_INLINE V8 min(V8 a, V8 b) { return __builtin_ia32_minpd512(a, b, kNoRounding); }
REGULUS_INLINE V8 max(V8 a, V8 b) { return __builtin_ia32_maxpd512(a, b, kNoRounding); }
#else
// The operand after the last argument fills the lanes that the mask excludes; here none.
enum { kAll = -1 };
REGULUS_INLINE V8 add_rd(V8 a, V8 b) { return __builtin_ia32_addpd512_mask(a, b, a, kAll, kDown); }
REGULUS_INLINE V8 add_ru(V8 a, V8 b) { return __builtin_ia32_addpd512_mask(a, b, a, kAll, kUp); }
REGULUS_INLINE V8 sub_rd(V8 a, V8 b) { return __builtin_ia32_subpd512_mask(a, b, a, kAll, kDown); }
REGULUS_INLINE V8 sub_ru(V8 a, V8 b) { return __builtin_ia32_subpd512_mask(a, b, a, kAll, kUp); }
REGULUS_INLINE V8 mul_rd(V8 a, V8 b) { return __builtin_ia32_mulpd512_mask(a, b, a, kAll, kDown); }
REGULUS_INLINE V8 mul_ru(V8 a, V8 b) { return __builtin_ia32_mulpd512_mask(a, b, a, kAll, kUp); }
REGULUS_INLINE V8 div_rd(V8 a, V8 b) { return __builtin_ia32_divpd512_mask(a, b, a, kAll, kDown); }
REGULUS_INLINE V8 div_ru(V8 a, V8 b) { return __builtin_ia32_divpd512_mask(a, b, a, kAll, kUp); }
REGULUS_INLINE V8 sqrt_rd(V8 a) { return __builtin_ia32_sqrtpd512_mask(a, a, kAll, kDown); }
REGULUS_INLINE V8 sqrt_ru(V8 a) { return __builtin_ia32_sqrtpd512_mask(a, a, kAll, kUp); }
REGULUS_INLINE V8 min(V8 a, V8 b) {
  return __builtin_ia32_minpd512_mask(a, b, a, kAll, kNoRounding);
}
REGULUS_INLINE V8 max(V8 a, V8 b) {
  return __builtin_ia32_maxpd512_mask(a, b, a, kAll, kNoRounding);
}
#endif

REGULUS_INLINE V8 fma_rd(V8 a, V8 b, V8 c) {
  return __builtin_ia32_vfmaddpd512_mask(a, b, c, 0xff, kDown);
}
REGULUS_INLINE V8 fma_ru(V8 a, V8 b, V8 c) {
  return __builtin_ia32_vfmaddpd512_mask(a, b, c, 0xff, kUp);
}
REGULUS_INLINE unsigned bits(M8 m) { return __builtin_ia32_cvtq2mask512(m); }

/// Returns where the sign bit is set. It is an integer comparison, so that it folds if x is
/// constant. It says "negative" for −0; its callers must allow for that.
REGULUS_INLINE M8 negative(V8 x) { return reinterpret_cast<M8>(x) < 0; }

#elif defined(REGULUS_ISA_AVX2)

REGULUS_INLINE V4 splat(double c) { return V4{c, c, c, c}; }
REGULUS_INLINE V4 magnitude(V4 x) {
  return reinterpret_cast<V4>(reinterpret_cast<M4>(x) & kMagnitudeBits);
}

REGULUS_INLINE V4 min(V4 a, V4 b) { return __builtin_ia32_minpd256(a, b); }
REGULUS_INLINE V4 max(V4 a, V4 b) { return __builtin_ia32_maxpd256(a, b); }
REGULUS_INLINE unsigned bits(M4 m) {
  return static_cast<unsigned>(__builtin_ia32_movmskpd256(reinterpret_cast<V4>(m)));
}
/// Returns `if_set` where the sign bit of x is set.
REGULUS_INLINE V4 sign_select(V4 x, V4 if_set, V4 otherwise) {
  return __builtin_ia32_blendvpd256(otherwise, if_set, x);
}

// Clang 22 no longer has the target's builtins, and its generic ones obey -frounding-math. Those of
// Clang 19 round to nearest.
#if !defined(__clang__) || __has_builtin(__builtin_ia32_vfmaddpd256)
REGULUS_INLINE V4 sqrt(V4 a) { return __builtin_ia32_sqrtpd256(a); }
REGULUS_INLINE V4 fma(V4 a, V4 b, V4 c) { return __builtin_ia32_vfmaddpd256(a, b, c); }
#else
REGULUS_INLINE V4 sqrt(V4 a) { return __builtin_elementwise_sqrt(a); }
REGULUS_INLINE V4 fma(V4 a, V4 b, V4 c) { return __builtin_elementwise_fma(a, b, c); }
#endif

#endif

}  // namespace regulus::simd
