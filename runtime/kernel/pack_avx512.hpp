// SPDX-License-Identifier: Apache-2.0
// Packs for AVX-512: one vector per bound. Each instruction contains its rounding, so MXCSR may
// have any rounding mode. The builtins are opaque to the optimisers: no bound is ever folded at
// compile time or merged with the other one.
#pragma once

#include "runtime/kernel/simd.hpp"

namespace regulus::pack {
inline namespace avx512 {

using V = simd::V8;
using M = simd::M8;
using simd::add_rd, simd::add_ru, simd::sub_rd, simd::sub_ru, simd::mul_rd, simd::mul_ru;
using simd::bits, simd::negative, simd::splat;
using simd::div_rd, simd::div_ru, simd::sqrt_rd, simd::sqrt_ru, simd::fma_rd, simd::fma_ru;
using simd::max, simd::min;

inline constexpr unsigned kRounding = 0;  // REGULUS_ROUND_NEAREST

REGULUS_INLINE V select(M m, V x, V y) { return m ? x : y; }

REGULUS_INLINE V row(const double* rows, int index) {
  return *reinterpret_cast<const simd::V8InMemory*>(rows + simd::kLanes * index);
}
REGULUS_INLINE void store_row(double* rows, int index, V x) {
  *reinterpret_cast<simd::V8InMemory*>(rows + simd::kLanes * index) = x;
}

// For doubles whose result is a double: any rounding gives it.
REGULUS_INLINE V add_exact(V a, V b) { return add_ru(a, b); }
REGULUS_INLINE V mul_exact(V a, V b) { return mul_ru(a, b); }
REGULUS_INLINE V fma_exact(V a, V b, V c) { return fma_ru(a, b, c); }

/// mul_rd for factors that are not negative: the result is not negative either.
REGULUS_INLINE V mul_rd_nonnegative(V a, V b) { return mul_rd(a, b); }

}  // namespace avx512
}  // namespace regulus::pack

#define REGULUS_PACK_OPERATION REGULUS_INLINE
#define REGULUS_PACK_ISA avx512
#include "runtime/kernel/pack_lo_hi.hpp"
