// SPDX-License-Identifier: Apache-2.0
// Builds an X8Backend from the evaluators, with the vectors of the instruction set that the
// including file is compiled for. Included by x8_portable.cpp, x8_avx2.cpp and x8_avx512.cpp only.
//
// Only always-inlined or ISA-namespaced functions may be used here; see elementary/lanes.hpp.
#pragma once

#include "runtime/interval/elementary/arcsine.hpp"
#include "runtime/interval/elementary/arctangent.hpp"
#include "runtime/interval/elementary/exponential.hpp"
#include "runtime/interval/elementary/trigonometric.hpp"
#include "runtime/interval/lanes.hpp"
#include "runtime/interval/x8_backend.hpp"

namespace regulus::detail::elementary {
inline namespace REGULUS_LANES_ISA {

/// Doubles in memory, seen as a vector.
typedef Vector VectorInMemory __attribute__((may_alias));

inline Bounds<Vector> load(const double* block) noexcept {
  return {*reinterpret_cast<const VectorInMemory*>(block),
          *reinterpret_cast<const VectorInMemory*>(block + kLanes)};
}

inline void store(double* block, const Bounds<Vector>& value) noexcept {
  *reinterpret_cast<VectorInMemory*>(block) = value.lo;
  *reinterpret_cast<VectorInMemory*>(block + kLanes) = value.hi;
}

inline VectorMask malformed(const Bounds<Vector>& x) noexcept { return ~(x.lo <= x.hi); }

/// Stores 0 in the undefined lanes, and in lanes where a bound exceeds the limit for kernels.
inline unsigned store_defined(double* block, const Partial<Vector>& result) noexcept {
  const Vector limit = splat<Vector>(0x1p128);
  const VectorMask inside = (result.value.lo >= -limit) & (result.value.hi <= limit);
  const VectorMask undefined = result.undefined | ~inside;
  const Vector zero = splat<Vector>(0);
  store(block,
        {select(undefined, zero, result.value.lo), select(undefined, zero, result.value.hi)});
  return lane_bits(undefined);
}

/// For functions that are defined and at most 2^128 everywhere.
inline unsigned store_total(double* block, const Bounds<Vector>& value, VectorMask bad) noexcept {
  const Vector zero = splat<Vector>(0);
  store(block, {select(bad, zero, value.lo), select(bad, zero, value.hi)});
  return lane_bits(bad);
}

template <class Function>
inline unsigned for_each_vector(Function function) noexcept {
  unsigned undefined = 0;
  for (unsigned lane = 0; lane < kLanes; lane += kVectorLanes) undefined |= function(lane) << lane;
  return undefined;
}

template <Partial<Vector> (*kFunction)(Bounds<Vector>) noexcept>
unsigned apply(const double* in, double* out) noexcept {
  return for_each_vector([=](unsigned lane) {
    const Bounds<Vector> x = load(in + lane);
    Partial<Vector> result = kFunction(x);
    result.undefined |= malformed(x);
    return store_defined(out + lane, result);
  });
}

template <Bounds<Vector> (*kFunction)(Bounds<Vector>) noexcept>
unsigned apply_total(const double* in, double* out) noexcept {
  return for_each_vector([=](unsigned lane) {
    const Bounds<Vector> x = load(in + lane);
    return store_total(out + lane, kFunction(x), malformed(x));
  });
}

inline Bounds<Vector> sin_bounds(Bounds<Vector> x) noexcept { return sin_cos_bounds(x).sin; }
inline Bounds<Vector> cos_bounds(Bounds<Vector> x) noexcept { return sin_cos_bounds(x).cos; }
inline Partial<Vector> exp_partial(Bounds<Vector> x) noexcept {
  return {exp_bounds(x), VectorMask{}};
}

inline unsigned apply_sincos(const double* in, double* out) noexcept {
  return for_each_vector([=](unsigned lane) {
    const Bounds<Vector> x = load(in + lane);
    const SinCosBounds<Vector> both = sin_cos_bounds(x);
    store_total(out + 2 * kLanes + lane, both.cos, malformed(x));
    return store_total(out + lane, both.sin, malformed(x));
  });
}

inline unsigned apply_atan2(const double* in, double* out) noexcept {
  return for_each_vector([=](unsigned lane) {
    const Bounds<Vector> y = load(in + lane);
    const Bounds<Vector> x = load(in + 2 * kLanes + lane);
    Partial<Vector> result = atan2_bounds(y, x);
    result.undefined |= malformed(y) | malformed(x);
    return store_defined(out + lane, result);
  });
}

inline constexpr X8Backend kBackend{apply_total<sin_bounds>,
                                    apply_total<cos_bounds>,
                                    apply_sincos,
                                    apply<tan_bounds<Vector>>,
                                    apply<asin_bounds<Vector>>,
                                    apply<acos_bounds<Vector>>,
                                    apply_total<atan_bounds<Vector>>,
                                    apply_atan2,
                                    apply<exp_partial>,
                                    apply<log_bounds<Vector>>};

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::elementary
