// SPDX-License-Identifier: Apache-2.0
// The loops of h_matrix.hpp, with the vectors of the instruction set that the including file is
// compiled for. Nothing here is a bound by itself: h_matrix.cpp says what follows from it.
#pragma once

#include "regulus/regularity/lanes.hpp"
#include "regulus/regularity/pack_lanes.hpp"

namespace regulus::h_matrix {
inline namespace REGULUS_LANES_ISA {

using namespace lanes::REGULUS_LANES_ISA;

inline PackArray constant(const double* x) noexcept { return {const_cast<double*>(x)}; }

/// Solves (I − P)v = 1 without pivoting, which is stable exactly where it matters: I − P is then an
/// M-matrix, all pivots are positive and every sum in the elimination has terms of one sign.
inline void solve_for_ones(const double* P, unsigned n, double* result) noexcept {
  alignas(64) double numbers[kMaxOrder * kMaxOrder * kLanes];
  const PackArray a{numbers}, v{result};
  const Pack one = Pack::of(1.0), zero = Pack::of(0.0);
  for (unsigned i = 0; i < n; ++i) {
    for (unsigned j = 0; j < n; ++j)
      a.put(i * n + j, (i == j ? one : zero) - constant(P)[i * n + j]);
    v.put(i, one);
  }
  for (unsigned k = 0; k < n; ++k) {
    const Pack reciprocal = one / a[k * n + k], pivot = v[k];
    for (unsigned i = k + 1; i < n; ++i) {
      const Pack factor = zero - a[i * n + k] * reciprocal;
      v.add_fused(i, factor, pivot);
      for (unsigned j = k + 1; j < n; ++j) a.add_fused(i * n + j, factor, a[k * n + j]);
    }
    a.put(k * n + k, reciprocal);
  }
  for (unsigned i = n; i-- > 0;) {
    Pack sum = v[i];
    for (unsigned j = i + 1; j < n; ++j) sum.subtract_fused(a[i * n + j], v[j]);
    v.put(i, sum * a[i * n + i]);
  }
}

/// Pv; for P, v ≥ 0 as raise_ru of lanes.hpp wants its sums.
inline void multiply(const double* P, const double* v, unsigned n, double* product) noexcept {
  for (unsigned i = 0; i < n; ++i) {
    Pack sum = Pack::of(0.0);
    for (unsigned j = 0; j < n; ++j) sum.add_fused(constant(P)[i * n + j], constant(v)[j]);
    sum.store(product + i * kLanes);
  }
}

/// Pᵀy.
inline void multiply_transposed(const double* P, const double* y, unsigned n,
                                double* product) noexcept {
  for (unsigned i = 0; i < n; ++i) Pack::of(0.0).store(product + i * kLanes);
  add_row_product(constant(y), {nullptr, n, constant(P), n}, n, {product});
}

/// v ← w/‖w‖ + v/2, largest entry 1; the second term damps the swinging of cyclic matrices. Returns
/// ‖w‖. Where w is zero v stays.
inline Pack power_step(PackArray w, PackArray v, unsigned n) noexcept {
  const Pack zero = Pack::of(0.0), half = Pack::of(0.5);
  Pack norm = zero;
  for (unsigned i = 0; i < n; ++i) norm = larger(w[i], norm);
  const Pack reciprocal = Pack::of(1.0) / norm;
  Pack largest = zero;
  for (unsigned i = 0; i < n; ++i) {
    const Pack x = select_less(zero, norm, w[i] * reciprocal + half * v[i], v[i]);
    v.put(i, x);
    largest = larger(x, largest);
  }
  const Pack scale = Pack::of(1.0) / largest;
  for (unsigned i = 0; i < n; ++i) v.put(i, v[i] * scale);
  return norm;
}

inline void perron(const double* P, unsigned n, double* v, double* y, double* radius) noexcept {
  constexpr int kSteps = 12;
  alignas(64) double product[kMaxOrder * kLanes];
  for (unsigned i = 0; i < n; ++i) {
    Pack::of(1.0).store(v + i * kLanes);
    Pack::of(1.0).store(y + i * kLanes);
  }
  Pack norm = Pack::of(0.0);
  for (int step = 0; step < kSteps; ++step) {
    multiply_transposed(P, y, n, product);
    static_cast<void>(power_step({product}, {y}, n));
    multiply(P, v, n, product);
    norm = power_step({product}, {v}, n);
  }
  norm.store(radius);
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::h_matrix
