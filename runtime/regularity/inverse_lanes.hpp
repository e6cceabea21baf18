// SPDX-License-Identifier: Apache-2.0
// Gauss–Jordan in place with row pivoting, eight matrices at a time. Lanes differ in their pivots:
// a row that has a larger one changes places with the pivot row in those lanes only.
#pragma once

#include "regulus/regularity/lanes.hpp"
#include "regulus/regularity/octet_lanes.hpp"

namespace regulus::inverse {
inline namespace REGULUS_LANES_ISA {

using namespace octet::REGULUS_LANES_ISA;

/// Exchanges entries of two rows, or columns, where large > small.
REGULUS_OCTET void exchange(Octets a, unsigned i, unsigned k, const Octet& small,
                            const Octet& large) noexcept {
  const Octet x = a[i], y = a[k];
  a.put(i, select_less(small, large, y, x));
  a.put(k, select_less(small, large, x, y));
}

inline void invert(double* matrix, unsigned n, double* determinant) noexcept {
  const Octets a{matrix};
  const Octet one = Octet::of(1.0), zero = Octet::of(0.0);
  Octet product = one;
  // Of each comparison: the magnitudes that were compared.
  Octet small[kMaxColumns * kMaxColumns], large[kMaxColumns * kMaxColumns];
  for (unsigned k = 0; k < n; ++k) {
    for (unsigned i = k + 1; i < n; ++i) {
      const Octet pivot = magnitude(a[k * n + k]), other = magnitude(a[i * n + k]);
      small[k * n + i] = pivot;
      large[k * n + i] = other;
      product = select_less(pivot, other, zero - product, product);
      for (unsigned j = 0; j < n; ++j) exchange(a, k * n + j, i * n + j, pivot, other);
    }
    const Octet pivot = a[k * n + k], reciprocal = one / pivot;
    product = product * pivot;
    a.put(k * n + k, one);
    for (unsigned j = 0; j < n; ++j) a.put(k * n + j, a[k * n + j] * reciprocal);
    for (unsigned i = 0; i < n; ++i) {
      if (i == k) continue;
      const Octet factor = zero - a[i * n + k];
      a.put(i * n + k, zero);
      for (unsigned j = 0; j < n; ++j) a.add_fused(i * n + j, factor, a[k * n + j]);
    }
  }
  for (unsigned k = n; k-- > 0;)
    for (unsigned i = n; i-- > k + 1;)
      for (unsigned row = 0; row < n; ++row)
        exchange(a, row * n + k, row * n + i, small[k * n + i], large[k * n + i]);
  product.store(determinant);
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::inverse
