// SPDX-License-Identifier: Apache-2.0
// The loops over minors, compiled once per instruction set.
#pragma once

#include "regulus/interval/x8_backend.hpp"

namespace regulus {

/// Any rounding mode; no state is kept. Sets of columns are bit masks.
struct ExpansionBackend {
  /// Minors of the first rows, level by level: D(S) = Σ_{j∈S} ±A[|S|−1][j]·D(S∖{j}), in interval
  /// arithmetic without outward steps. result: lower bound of each lane, then upper.
  using Expand = void (*)(const double* matrix, unsigned n, double* result) noexcept;
  /// The same sum for magnitudes without signs, each level times `factor` plus 2^-1000.
  using Permanent = void (*)(const double* magnitude, unsigned n, double factor,
                             double* result) noexcept;
  /// Whether the vertex determinants of one matrix, as computed, all exceed `error` or all stay
  /// below −error. lo, hi: n·n bounds.
  using VerticesShareSign = bool (*)(const double* lo, const double* hi, unsigned n,
                                     double error) noexcept;
  Expand expand;
  Permanent permanent;
  VerticesShareSign vertices_share_sign;
};

/// Requires  x8_available(isa) before a function of it is called.
[[nodiscard]] const ExpansionBackend& expansion_backend(X8Isa isa) noexcept;

/// That of the widest vectors this processor has.
[[nodiscard]] const ExpansionBackend& expansion_backend() noexcept;

extern const ExpansionBackend kExpansionBaseline;
#if defined(__x86_64__)
extern const ExpansionBackend kExpansionAvx2;
extern const ExpansionBackend kExpansionAvx512;
#endif

}  // namespace regulus
