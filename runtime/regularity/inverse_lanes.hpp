// SPDX-License-Identifier: Apache-2.0
// Gauss–Jordan in place with row pivoting, eight matrices at a time. Lanes differ in their pivots:
// a row with a larger one is exchanged with the pivot row in those lanes only.
#pragma once

#include "runtime/regularity/lanes.hpp"
#include "runtime/regularity/pack_lanes.hpp"

namespace regulus::inverse {
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

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::inverse
