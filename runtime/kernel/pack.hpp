// SPDX-License-Identifier: Apache-2.0
// Eight intervals, or eight exact doubles, one per lane: the arithmetic of generated kernels.
//
// A kernel is compiled with one of REGULUS_ISA_AVX512, REGULUS_ISA_AVX2, REGULUS_ISA_PORTABLE and
// the flags of runtime/kernel/isa.hpp. Only our own headers are included.
//
//   I                      8 intervals          P                      8 exact doubles
//   load(boxes, v) → I     variable v           point(points, p) → P   entry p of K
//   store(out, e, I)       output e             P(c)                   a double in every lane
//   constant(lo, hi) → I   the same interval in every lane             thin(P) → I
//   kRounding              the REGULUS_ROUND_… that these packs need
//
//   -I  I+I  I-I  I*I      I+P  P+I  I-P  P-I  I*P  P*I      -P (exact)   P+P → I  P-P → I  P*P → I
//   mul_add(a, b, c) = a·b + c, rounded once: (P, I, I)  (I, P, I)  (I, I, I)  (P, P, I)
//   sqr(I)  pow(I, n) n ≥ 2, tight  abs(I)  sin(I)  cos(I)  atan(I)  sincos(I, I& sine, I& cosine)
//
//   exact_add  exact_sub  exact_mul  exact_mul_add(p, q, r) = p·q + r: of P, if every intermediate
//   result is a double → P      point_of(thin(p)) = p
//
// Some operations are not defined everywhere, or their result may be unbounded. They take the mask
// of undefined lanes, and set the bits of the lanes where some point of the argument is outside
// their domain, or the result is not finite:
//   div(I, I, undefined)  sqrt(I, undefined)  tan  asin  acos  atan2(I, I, undefined)  exp  log
//   checked(I, undefined): the argument; sets the lanes in which a bound is not finite
// Their results in such lanes are finite but meaningless; otherwise magnitudes are ≤ 2^128 (a
// larger quotient, tangent or exponential counts as undefined).
//
// Requires  operands with finite bounds. A sum, product or power can overflow to ±∞; multiplied by
//           0 that is a NaN, which vector min and max silently drop. So if a value can overflow for
//           the magnitudes that its operands can have, it goes through `checked` before any other
//           use.
// Ensures   in every lane whose bit stays 0, the result encloses the operation on the argument
//           sets.
//           -0 and +0 are the same bound.
// Rounding  AVX-512: embedded, any MXCSR rounding. AVX2: MXCSR upward, intervals kept as (−lo, hi).
//           Portable: to nearest, then outward. All: no flush to zero, no denormals-are-zero.
//
// Cost, in vector instructions of AVX-512 after a value's sign mask is known: I+I 2, P+P 2, P*P 2,
// P*I 4 (2 if P is a literal), mul_add(P, I, I) the same: the sum is free. I*I 10, of which 4
// choose factors by the sign of the *left* operand's bounds: put there what has a known or reused
// sign. mul_add(I, I, I) 10. Literals are written as doubles: P(3.0), since a compiler that honours
// the rounding mode converts an integer 3 when it runs.
#pragma once

#if defined(REGULUS_ISA_AVX512)
#include "runtime/kernel/pack_avx512.hpp"
#elif defined(REGULUS_ISA_AVX2)
#include "runtime/kernel/pack_avx2.hpp"
#elif defined(REGULUS_ISA_PORTABLE)
#include "runtime/kernel/pack_portable.hpp"
#else
#error "define REGULUS_ISA_AVX512, REGULUS_ISA_AVX2 or REGULUS_ISA_PORTABLE"
#endif
