// SPDX-License-Identifier: Apache-2.0
// Packs for AVX2: two vectors of four lanes per bound. Intervals are kept as (−lo, hi), so that one
// rounding mode, upward, serves both bounds.
//
// Requires  MXCSR upward, no flush to zero; -frounding-math -ffp-contract=off.
// Rounding  no bound is the negation of a rounded result: −(a·b) is written as a product with one
//           factor negated *before* it, or with |a| and the other bound. If a compiler still
//           replaced −((−a)·b) by a·b, the self-test would detect it.
#pragma once

#include "runtime/kernel/pack_avx2_half.hpp"
#include "runtime/kernel/simd.hpp"

namespace regulus::pack {
inline namespace avx2 {

inline constexpr unsigned kRounding = 1;  // REGULUS_ROUND_UPWARD

/// Eight exact doubles.
struct P {
  V a, b;
  __attribute__((always_inline)) explicit P(double c) : a(splat(c)), b(splat(c)) {}
  __attribute__((always_inline)) P(V first, V second) : a(first), b(second) {}
};

/// Eight intervals.
struct I {
  Half a, b;
};

REGULUS_INLINE V row(const double* rows, int start) {
  return *reinterpret_cast<const simd::V4InMemory*>(rows + start);
}
REGULUS_INLINE void store_row(double* rows, int start, V values) {
  *reinterpret_cast<simd::V4InMemory*>(rows + start) = values;
}
REGULUS_INLINE I load(const double* boxes, int v) {
  const int lo = 2 * simd::kLanes * v, hi = lo + simd::kLanes;
  return {{-row(boxes, lo), row(boxes, hi)}, {-row(boxes, lo + 4), row(boxes, hi + 4)}};
}
REGULUS_INLINE P point(const double* points, int p) {
  return P(row(points, simd::kLanes * p), row(points, simd::kLanes * p + 4));
}
REGULUS_INLINE void store(double* out, int e, I x) {
  const int lo = 2 * simd::kLanes * e, hi = lo + simd::kLanes;
  store_row(out, lo, -x.a.nlo);
  store_row(out, lo + 4, -x.b.nlo);
  store_row(out, hi, x.a.hi);
  store_row(out, hi + 4, x.b.hi);
}
REGULUS_INLINE I constant(double lo, double hi) {
  const Half half = {splat(-lo), splat(hi)};
  return {half, half};
}
REGULUS_INLINE I thin(P p) { return {{-p.a, p.a}, {-p.b, p.b}}; }
REGULUS_INLINE P point_of(I x) { return P(x.a.hi, x.b.hi); }

REGULUS_INLINE P operator-(P p) { return P(-p.a, -p.b); }
REGULUS_INLINE I operator+(P p, P q) { return {add(p.a, q.a), add(p.b, q.b)}; }
REGULUS_INLINE I operator-(P p, P q) { return p + (-q); }
REGULUS_INLINE I operator*(P p, P q) { return {mul(p.a, q.a), mul(p.b, q.b)}; }

REGULUS_INLINE P exact_add(P p, P q) { return P(p.a + q.a, p.b + q.b); }
REGULUS_INLINE P exact_sub(P p, P q) { return P(p.a - q.a, p.b - q.b); }
REGULUS_INLINE P exact_mul(P p, P q) { return P(p.a * q.a, p.b * q.b); }
REGULUS_INLINE P exact_mul_add(P p, P q, P r) {
  return P(simd::fma(p.a, q.a, r.a), simd::fma(p.b, q.b, r.b));
}

REGULUS_INLINE I operator-(I x) { return {negate(x.a), negate(x.b)}; }
REGULUS_INLINE I operator+(I x, I y) { return {add(x.a, y.a), add(x.b, y.b)}; }
REGULUS_INLINE I operator-(I x, I y) { return x + (-y); }
REGULUS_INLINE I operator*(I x, I y) { return {mul(x.a, y.a), mul(x.b, y.b)}; }

REGULUS_INLINE I operator+(I x, P p) { return {add(x.a, p.a), add(x.b, p.b)}; }
REGULUS_INLINE I operator+(P p, I x) { return x + p; }
REGULUS_INLINE I operator-(I x, P p) { return x + (-p); }
REGULUS_INLINE I operator-(P p, I x) { return -x + p; }
REGULUS_INLINE I operator*(P p, I x) { return {mul(p.a, x.a), mul(p.b, x.b)}; }
REGULUS_INLINE I operator*(I x, P p) { return p * x; }

REGULUS_INLINE I mul_add(P p, P q, I z) { return {mul_add(p.a, q.a, z.a), mul_add(p.b, q.b, z.b)}; }
REGULUS_INLINE I mul_add(P p, I x, I z) { return {mul_add(p.a, x.a, z.a), mul_add(p.b, x.b, z.b)}; }
REGULUS_INLINE I mul_add(I x, P p, I z) { return mul_add(p, x, z); }
REGULUS_INLINE I mul_add(I x, I y, I z) { return {mul_add(x.a, y.a, z.a), mul_add(x.b, y.b, z.b)}; }

REGULUS_INLINE I abs(I x) { return {abs(x.a), abs(x.b)}; }
REGULUS_INLINE I sqr(I x) { return {sqr(x.a), sqr(x.b)}; }
REGULUS_INLINE I pow(I x, unsigned n) { return {pow(x.a, n), pow(x.b, n)}; }

/// Returns the result of an operation on both halves; sets the bits of lanes that are not good.
REGULUS_INLINE I joined(Partial a, Partial b, unsigned& undefined) {
  undefined |= bits(~a.good) | bits(~b.good) << 4;
  return {zero_unless(a.good, a.value), zero_unless(b.good, b.value)};
}
REGULUS_INLINE I checked(I x, unsigned& undefined) {
  return joined(checked(x.a), checked(x.b), undefined);
}
REGULUS_INLINE I div(I x, I y, unsigned& undefined) {
  return joined(div(x.a, y.a), div(x.b, y.b), undefined);
}
REGULUS_INLINE I sqrt(I x, unsigned& undefined) { return joined(sqrt(x.a), sqrt(x.b), undefined); }

}  // namespace avx2
}  // namespace regulus::pack

#define REGULUS_PACK_ISA avx2
#include "runtime/kernel/pack_functions.hpp"
