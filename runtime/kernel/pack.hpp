// SPDX-License-Identifier: Apache-2.0
// Eight intervals, or eight exact doubles, one per lane: the arithmetic of generated kernels.
//
// One of REGULUS_ISA_AVX512, REGULUS_ISA_AVX2, REGULUS_ISA_PORTABLE is defined by whoever compiles
// the kernel. With REGULUS_NO_SYSTEM_HEADERS (code compiled in process) no other header is included.
//
//   I                      8 intervals          P                      8 exact doubles
//   load(boxes, v) → I     variable v           point(points, p) → P   entry p of K
//   store(out, e, I)       output e             P(c)                   an exact double in every lane
//   constant(lo, hi) → I   the same interval in every lane
//
//   -I  I+I  I-I  I*I      I+P  P+I  I-P  P-I  I*P  P*I      -P (exact)   P+P → I  P-P → I  P*P → I
//   sqr(I)  pow(I, n) n ≥ 3 (compile-time or constant n)  abs(I)  sin(I)  cos(I)  atan(I)
//
// Operations that are not defined everywhere, or whose result may be unbounded, take the mask of
// undefined lanes and set the bits of the lanes where some point of the argument is outside their
// domain, or the result is not finite:
//   div(I, I, undefined)  sqrt(I, undefined)  tan  asin  acos  atan2(I, I, undefined)  exp  log
//   checked(I, undefined): the argument; sets the lanes in which a bound is not finite
// Their results in such lanes are finite but meaningless; otherwise magnitudes are ≤ 2^128 (a larger
// quotient, tangent or exponential counts as undefined).
//
// Ensures   in every lane whose bit stays 0, the result encloses the operation on the argument sets,
//           provided all operand bounds are finite.
// Rounding  AVX-512: embedded, any MXCSR rounding. AVX2: MXCSR upward, intervals kept as (−lo, hi).
//           Portable: to nearest, then outward.
#pragma once

#if defined(REGULUS_ISA_AVX512)
#include "regulus/kernel/pack_avx512.hpp"
#elif defined(REGULUS_ISA_AVX2)
#include "regulus/kernel/pack_avx2.hpp"
#elif defined(REGULUS_ISA_PORTABLE)
#include "regulus/kernel/pack_portable.hpp"
#else
#error "define REGULUS_ISA_AVX512, REGULUS_ISA_AVX2 or REGULUS_ISA_PORTABLE"
#endif
