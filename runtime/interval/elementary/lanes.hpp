// SPDX-License-Identifier: Apache-2.0
// The same operations for one double and for a vector of doubles. So an evaluator is written once,
// without branches, and gives the same bits in every lane on every instruction set.
//
// A mask is an integer per lane, all ones or all zeros. All operations are ones that IEEE 754
// rounds correctly (there is no fused multiply-add): therefore the bits agree.
//
// Everything that uses this header is in a namespace named after the instruction set: the linker
// must not replace a function compiled for a plain CPU by its namesake compiled for AVX-512.
#pragma once

#include <cstdint>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#if defined(__AVX512F__) && defined(__AVX512DQ__)
#define REGULUS_LANES_ISA for_avx512
#define REGULUS_VECTOR_BYTES 64
#elif defined(__AVX2__)
#define REGULUS_LANES_ISA for_avx2
#define REGULUS_VECTOR_BYTES 32
#else
#define REGULUS_LANES_ISA for_portable
#define REGULUS_VECTOR_BYTES 16
#endif

namespace regulus::detail::elementary {
inline namespace REGULUS_LANES_ISA {

typedef double Vector __attribute__((vector_size(REGULUS_VECTOR_BYTES)));
typedef std::uint64_t VectorBits __attribute__((vector_size(REGULUS_VECTOR_BYTES)));
using VectorMask = decltype(Vector{} < Vector{});
inline constexpr int kVectorLanes = REGULUS_VECTOR_BYTES / 8;

template <class T>
struct Lanes;
template <>
struct Lanes<double> {
  using Bits = std::uint64_t;
  using Mask = std::int64_t;
};
template <>
struct Lanes<Vector> {
  using Bits = VectorBits;
  using Mask = VectorMask;
};
template <class T>
using Bits = typename Lanes<T>::Bits;
template <class T>
using Mask = typename Lanes<T>::Mask;

/// Returns the same number in every lane; T(c) for any other arithmetic type.
template <class T>
inline T splat(double c) noexcept {
  return T(c);
}
template <>
inline Vector splat<Vector>(double c) noexcept {
  return c - Vector{};
}

inline std::uint64_t to_bits(double x) noexcept { return __builtin_bit_cast(std::uint64_t, x); }
inline VectorBits to_bits(Vector x) noexcept { return reinterpret_cast<VectorBits>(x); }
inline double from_bits(std::uint64_t b) noexcept { return __builtin_bit_cast(double, b); }
inline Vector from_bits(VectorBits b) noexcept { return reinterpret_cast<Vector>(b); }

inline std::int64_t less(double a, double b) noexcept { return -std::int64_t{a < b}; }
inline VectorMask less(Vector a, Vector b) noexcept { return a < b; }
inline std::int64_t equal(double a, double b) noexcept { return -std::int64_t{a == b}; }
inline VectorMask equal(Vector a, Vector b) noexcept { return a == b; }
inline std::int64_t differ(std::uint64_t a, std::uint64_t b) noexcept {
  return -std::int64_t{a != b};
}
inline VectorMask differ(VectorBits a, VectorBits b) noexcept { return a != b; }

inline double select(std::int64_t mask, double yes, double no) noexcept { return mask ? yes : no; }
inline Vector select(VectorMask mask, Vector yes, Vector no) noexcept { return mask ? yes : no; }

inline double square_root(double x) noexcept { return __builtin_sqrt(x); }
inline Vector square_root(Vector x) noexcept {
#if REGULUS_VECTOR_BYTES == 64
  return _mm512_maskz_sqrt_pd(0xff, x);
#elif REGULUS_VECTOR_BYTES == 32
  return _mm256_sqrt_pd(x);
#else
  return Vector{__builtin_sqrt(x[0]), __builtin_sqrt(x[1])};
#endif
}

/// Returns one bit per lane; lane 0 is the least significant.
inline unsigned lane_bits(VectorMask mask) noexcept {
#if REGULUS_VECTOR_BYTES == 64
  return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask));
#elif REGULUS_VECTOR_BYTES == 32
  return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(mask)));
#else
  return static_cast<unsigned>((mask[0] & 1) | (mask[1] & 2));
#endif
}

inline constexpr std::uint64_t kSignBit = std::uint64_t{1} << 63;

template <class T>
inline T magnitude(T x) noexcept {
  return from_bits(to_bits(x) & ~kSignBit);
}
/// |x| with the sign of s, for x ≥ +0.
template <class T>
inline T with_sign_of(T x, T s) noexcept {
  return from_bits(to_bits(x) | (to_bits(s) & kSignBit));
}

template <class T>
inline T smaller(T a, T b) noexcept {
  return select(less(b, a), b, a);
}
template <class T>
inline T larger(T a, T b) noexcept {
  return select(less(a, b), b, a);
}
#if REGULUS_VECTOR_BYTES == 64
inline Vector smaller(Vector a, Vector b) noexcept { return _mm512_maskz_min_pd(0xff, b, a); }
inline Vector larger(Vector a, Vector b) noexcept { return _mm512_maskz_max_pd(0xff, b, a); }
#elif REGULUS_VECTOR_BYTES == 32
inline Vector smaller(Vector a, Vector b) noexcept { return _mm256_min_pd(b, a); }
inline Vector larger(Vector a, Vector b) noexcept { return _mm256_max_pd(b, a); }
#endif

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::elementary
