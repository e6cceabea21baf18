// SPDX-License-Identifier: Apache-2.0
// The loops of h_matrix.hpp, with the vectors of the instruction set for which the including file
// is compiled. Nothing here is a bound by itself: h_matrix.cpp derives the bounds.
#pragma once

#include "runtime/regularity/lanes.hpp"
#include "runtime/regularity/pack_lanes.hpp"

namespace regulus::detail::h_matrix {
inline namespace REGULUS_LANES_ISA {

using namespace lanes::REGULUS_LANES_ISA;

/// x·kOneSum is above the exact value of one sum whose floating-point value is x ≥ 0. A sum of doubles
/// that is not zero is a multiple of 2^-1074, and here (l − 1) at least 2^-53: the product cannot
/// underflow.
inline constexpr double kOneSum = 1.0 + 0x1p-51;

inline void distance(ConstIntervalMatrix product, PointMatrix result) noexcept {
  const unsigned n = result.rows();
  const double* bounds = product.data();
  for (unsigned i = 0; i < n; ++i)
    for (unsigned j = 0; j < n; ++j, bounds += 2 * kLanes) {
      const Pack one = Pack::of(i == j ? 1.0 : 0.0);
      const Pack lo = magnitude(Pack::load(bounds) - one);
      const Pack hi = magnitude(Pack::load(bounds + kLanes) - one);
      const Pack size = select_less(lo, hi, hi, lo);
      packs_of(result).put(i * n + j, i == j ? size * Pack::of(kOneSum) : size);
    }
}

inline void lower_to_mean_value(const MeanValueInput& input, PointMatrix P) noexcept {
  const unsigned entries = P.size(), variables = input.radius.rows();
  const Pack more = Pack::load(input.more);
  for (unsigned e = 0; e < entries; ++e) {
    Pack sum = Pack::load(input.center.data() + e * kLanes);
    for (unsigned k = 0; k < variables; ++k) {
      const double* bounds = input.derivatives.data() + std::size_t{2} * (k * entries + e) * kLanes;
      const Pack lo = magnitude(Pack::load(bounds)), hi = magnitude(Pack::load(bounds + kLanes));
      sum.add_product(select_less(lo, hi, hi, lo), Pack::load(input.radius.data() + k * kLanes));
    }
    const Pack bound = raised(sum, input.factor) + more, current = packs_of(P)[e];
    packs_of(P).put(e, select_less(bound, current, bound, current));
  }
}

/// Solves (I − P)v = 1 without pivoting. It is stable in the important case: I − P is an M-matrix,
/// all pivots are positive and every sum in the elimination has terms of one sign.
inline void solve_for_ones(ConstPointMatrix matrix, PointVector result) noexcept {
  const unsigned n = matrix.rows();
  alignas(64) double numbers[kMaxOrder * kMaxOrder * kLanes];
  const PackArray a{numbers}, P = packs_of(matrix), v = packs_of(result);
  const Pack one = Pack::of(1.0), zero = Pack::of(0.0);
  for (unsigned i = 0; i < n; ++i) {
    for (unsigned j = 0; j < n; ++j) a.put(i * n + j, (i == j ? one : zero) - P[i * n + j]);
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

/// Computes Pv; for P, v ≥ 0, raise_ru of lanes.hpp bounds its sums.
inline void multiply(ConstPointMatrix matrix, ConstPointVector vector,
                     PointVector product) noexcept {
  const unsigned n = matrix.rows();
  const PackArray P = packs_of(matrix), v = packs_of(vector);
  for (unsigned i = 0; i < n; ++i) {
    Pack sum = Pack::of(0.0);
    for (unsigned j = 0; j < n; ++j) sum.add_fused(P[i * n + j], v[j]);
    packs_of(product).put(i, sum);
  }
}

/// Computes Pᵀy.
inline void multiply_transposed(ConstPointMatrix P, ConstPointVector y,
                                PointVector product) noexcept {
  const unsigned n = P.rows();
  for (unsigned i = 0; i < n; ++i) packs_of(product).put(i, Pack::of(0.0));
  add_row_product(packs_of(y), {nullptr, n, packs_of(P), n}, n, packs_of(product));
}

/// v ← w/‖w‖ + v/2, largest entry 1; the second term damps the oscillation of cyclic matrices.
/// Returns ‖w‖. If w is zero, v does not change.
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

inline void perron(ConstPointMatrix P, PerronVectors vectors, LaneNumbers& radius) noexcept {
  const unsigned n = P.rows();
  const PackArray v = packs_of(vectors.right), y = packs_of(vectors.left);
  constexpr int kSteps = 12;
  alignas(64) double numbers[kMaxOrder * kLanes];
  const PointVector product(numbers, n);
  for (unsigned i = 0; i < n; ++i) {
    v.put(i, Pack::of(1.0));
    y.put(i, Pack::of(1.0));
  }
  Pack norm = Pack::of(0.0);
  for (int step = 0; step < kSteps; ++step) {
    multiply_transposed(P, vectors.left, product);
    static_cast<void>(power_step(packs_of(product), y, n));
    multiply(P, vectors.right, product);
    norm = power_step(packs_of(product), v, n);
  }
  norm.store(radius.of);
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::h_matrix
