// SPDX-License-Identifier: Apache-2.0
// Gauss–Jordan in place with row pivoting, eight matrices at a time. Lanes differ in their pivots:
// a row with a larger one is exchanged with the pivot row in those lanes only. Then the rounding to a
// grid, and the middles to invert.
#pragma once

#include "runtime/regularity/lanes.hpp"
#include "runtime/regularity/pack_lanes.hpp"

namespace regulus::detail::inverse {
inline namespace REGULUS_LANES_ISA {

using namespace lanes::REGULUS_LANES_ISA;

/// Exchanges entries of two rows, or columns, where large > small.
REGULUS_LANE_INLINE void exchange(PackArray a, unsigned i, unsigned k, const Pack& small,
                                  const Pack& large) noexcept {
  const Pack x = a[i], y = a[k];
  a.put(i, select_less(small, large, y, x));
  a.put(k, select_less(small, large, x, y));
}

inline void invert(PointMatrix matrix, LaneNumbers& determinant) noexcept {
  const unsigned n = matrix.rows();
  const PackArray a = packs_of(matrix);
  const Pack one = Pack::of(1.0), zero = Pack::of(0.0);
  Pack product = one;
  // The magnitudes of each comparison.
  Pack small[kMaxColumns * kMaxColumns], large[kMaxColumns * kMaxColumns];
  for (unsigned k = 0; k < n; ++k) {
    for (unsigned i = k + 1; i < n; ++i) {
      const Pack pivot = magnitude(a[k * n + k]), other = magnitude(a[i * n + k]);
      small[k * n + i] = pivot;
      large[k * n + i] = other;
      product = select_less(pivot, other, zero - product, product);
      for (unsigned j = 0; j < n; ++j) exchange(a, k * n + j, i * n + j, pivot, other);
    }
    const Pack pivot = a[k * n + k], reciprocal = one / pivot;
    product = product * pivot;
    a.put(k * n + k, one);
    for (unsigned j = 0; j < n; ++j) a.put(k * n + j, a[k * n + j] * reciprocal);
    for (unsigned i = 0; i < n; ++i) {
      if (i == k) continue;
      const Pack factor = zero - a[i * n + k];
      a.put(i * n + k, zero);
      for (unsigned j = 0; j < n; ++j) a.add_fused(i * n + j, factor, a[k * n + j]);
    }
  }
  for (unsigned k = n; k-- > 0;)
    for (unsigned i = n; i-- > k + 1;)
      for (unsigned row = 0; row < n; ++row)
        exchange(a, row * n + k, row * n + i, small[k * n + i], large[k * n + i]);
  product.store(determinant.of);
}

/// Returns the power of two below x > 0 that is normal; else 0 or ∞.
REGULUS_LANE_INLINE Pack power_below(const Pack& x) noexcept {
  constexpr std::uint64_t kExponent = 0x7ff0000000000000;
  Pack power;
  for (unsigned p = 0; p < Pack::kParts; ++p)
    power.part[p] = elementary::from_bits(elementary::to_bits(x.part[p]) & kExponent);
  return power;
}

/// Rounds each row to a grid. With 2^L the power of two below the greatest entry, the grid is
/// 2^(L−27): adding and subtracting 1.5·2^52 times the grid leaves the nearest multiple of the grid,
/// or the next one in another rounding mode. Returns the lanes in which a row is too small for a
/// grid, or an entry is not finite.
inline LaneMask round_rows_to_grid(PointMatrix matrix) noexcept {
  const PackArray a = packs_of(matrix);
  const Pack zero = Pack::of(0.0), least = Pack::of(0x1p-800);
  Pack nothing = zero;  // 0, or NaN after an entry that is not finite
  LaneMask without = 0;
  for (unsigned i = 0; i < matrix.rows(); ++i) {
    const PackArray row = a + i * matrix.columns();
    Pack greatest = zero;
    for (unsigned j = 0; j < matrix.columns(); ++j) greatest = larger(magnitude(row[j]), greatest);
    const Pack anchor = power_below(greatest) * Pack::of(0x1.8p25);
    for (unsigned j = 0; j < matrix.columns(); ++j) {
      const Pack rounded = (row[j] + anchor) - anchor;
      row.put(j, rounded);
      nothing = nothing + rounded * zero;
    }
    without |= less_lanes(zero, greatest) & less_lanes(greatest, least);
  }
  return without | (kAllLanes & ~less_lanes(nothing, Pack::of(1.0)));
}

/// Returns the lanes in which no magnitude exceeds the limit; NaN does not count.
inline LaneMask within(ConstPointMatrix matrix, double limit) noexcept {
  const PackArray a = packs_of(matrix);
  Pack greatest = Pack::of(0.0);
  for (unsigned e = 0; e < matrix.size(); ++e) greatest = larger(magnitude(a[e]), greatest);
  return kAllLanes & ~less_lanes(Pack::of(limit), greatest);
}

inline void take_middles(ConstIntervalMatrix matrix, PointMatrix middles) noexcept {
  const PackArray bounds{const_cast<double*>(matrix.data())}, a = packs_of(middles);
  const Pack half = Pack::of(0.5);
  for (unsigned e = 0; e < matrix.size(); ++e)
    a.put(e, half * bounds[2 * e] + half * bounds[2 * e + 1]);
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::inverse
