// SPDX-License-Identifier: Apache-2.0
// Error-free transforms: high + low is the exact result, high the nearest double to it.
#pragma once

#include "runtime/interval/elementary/lanes.hpp"

namespace regulus::detail::elementary {
inline namespace REGULUS_LANES_ISA {

/// An unevaluated sum.
template <class T>
struct Parts {
  T high;
  T low;
};

/// Requires  a + b finite. Source: Knuth, TAOCP vol. 2, §4.2.2.
template <class T>
inline Parts<T> two_sum(T a, T b) noexcept {
  const T sum = a + b;
  const T b_part = sum - a;
  const T a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

/// Requires  a = 0 or |a| ≥ |b|. Source: Dekker 1971.
template <class T>
inline Parts<T> fast_two_sum(T a, T b) noexcept {
  const T sum = a + b;
  return {sum, b - (sum - a)};
}

/// Requires  |a|, |b| < 2^996; a·b = 0 or |a·b| ≥ 2^-968.
/// Source    Dekker 1971, with Veltkamp's splitting.
template <class T>
inline Parts<T> two_product(T a, T b) noexcept {
  const T product = a * b;
  const T splitter = splat<T>(0x1p27 + 1);
  const T a_scaled = a * splitter;
  const T b_scaled = b * splitter;
  const T a_high = a_scaled - (a_scaled - a);
  const T b_high = b_scaled - (b_scaled - b);
  const T a_low = a - a_high;
  const T b_low = b - b_high;
  const T low = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
  return {product, low};
}

/// c[0] + c[1]·x + …, by Horner's rule in x² over pairs: half the latency of the rule in x.
template <class T, int kTerms>
inline T polynomial(T x, const double (&c)[kTerms]) noexcept {
  static_assert(kTerms >= 3);
  const auto pair = [&](int i) { return splat<T>(c[i]) + splat<T>(c[i + 1]) * x; };
  const T square = x * x;
  constexpr bool kOdd = kTerms % 2 != 0;
  T sum = kOdd ? splat<T>(c[kTerms - 1]) : pair(kTerms - 2);
  for (int i = kTerms - (kOdd ? 3 : 4); i >= 0; i -= 2) sum = pair(i) + square * sum;
  return sum;
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::elementary
