// SPDX-License-Identifier: Apache-2.0
// Elementary functions of packs: eight lanes at a time through the interval library, which works in
// any rounding mode. Included by each pack after its arithmetic.
#pragma once

// Declared again here, not included: this header must compile without any other.
extern "C" {
unsigned regulus_x8_sin(const double* in, double* out);
unsigned regulus_x8_cos(const double* in, double* out);
unsigned regulus_x8_tan(const double* in, double* out);
unsigned regulus_x8_asin(const double* in, double* out);
unsigned regulus_x8_acos(const double* in, double* out);
unsigned regulus_x8_atan(const double* in, double* out);
unsigned regulus_x8_exp(const double* in, double* out);
unsigned regulus_x8_log(const double* in, double* out);
unsigned regulus_x8_sincos(const double* in, double* out);
unsigned regulus_x8_atan2(const double* in, double* out);
}

namespace regulus::pack {
inline namespace REGULUS_PACK_ISA {

/// A function of the library: one interval in, one out; returns the mask of undefined lanes. The
/// outputs are 0 in those, and at most 2^128 in magnitude in the others (runtime/interval/x8.hpp).
using LibraryFunction = unsigned (*)(const double* in, double* out);

REGULUS_INLINE I call_library(LibraryFunction f, I x, unsigned& undefined) {
  alignas(64) double in[2 * simd::kLanes], out[2 * simd::kLanes];
  store(in, 0, x);
  undefined |= f(in, out);
  return load(out, 0);
}
/// Calls a function that is defined and bounded everywhere.
REGULUS_INLINE I call_library(LibraryFunction f, I x) {
  unsigned none = 0;
  return call_library(f, x, none);
}

REGULUS_INLINE I sin(I x) { return call_library(regulus_x8_sin, x); }
REGULUS_INLINE I cos(I x) { return call_library(regulus_x8_cos, x); }
REGULUS_INLINE I atan(I x) { return call_library(regulus_x8_atan, x); }
REGULUS_INLINE I tan(I x, unsigned& undefined) {
  return call_library(regulus_x8_tan, x, undefined);
}
REGULUS_INLINE I asin(I x, unsigned& undefined) {
  return call_library(regulus_x8_asin, x, undefined);
}
REGULUS_INLINE I acos(I x, unsigned& undefined) {
  return call_library(regulus_x8_acos, x, undefined);
}
REGULUS_INLINE I exp(I x, unsigned& undefined) {
  return call_library(regulus_x8_exp, x, undefined);
}
REGULUS_INLINE I log(I x, unsigned& undefined) {
  return call_library(regulus_x8_log, x, undefined);
}

REGULUS_INLINE I atan2(I y, I x, unsigned& undefined) {
  alignas(64) double in[4 * simd::kLanes], out[2 * simd::kLanes];
  store(in, 0, y);
  store(in, 1, x);
  undefined |= regulus_x8_atan2(in, out);
  return load(out, 0);
}

/// Computes both at the cost of little more than one.
REGULUS_INLINE void sincos(I x, I& sine, I& cosine) {
  alignas(64) double in[2 * simd::kLanes], out[4 * simd::kLanes];
  store(in, 0, x);
  regulus_x8_sincos(in, out);
  sine = load(out, 0);
  cosine = load(out, 1);
}

}  // namespace REGULUS_PACK_ISA
}  // namespace regulus::pack
