// SPDX-License-Identifier: Apache-2.0
// The loops of the regularity tests, compiled once per instruction set. Any rounding mode; no state
// is kept. Arrays are in the layouts of lanes.hpp. What the functions claim is said where they are
// used.
#pragma once

#include "regulus/interval/isa.hpp"
#include "regulus/interval/lanes.hpp"

namespace regulus {

struct SecondOrderPlan;
struct SecondOrderInput;
struct SecondOrderWork;
struct OrthantProblem;
struct OrthantCell;

struct RegularityBackend {
  // minors_lanes.hpp. Sets of columns are bit masks.

  /// Minors of the first rows, level by level: D(S) = Σ_{j∈S} ±A[|S|−1][j]·D(S∖{j}), in interval
  /// arithmetic without outward steps. result: lower bound of each lane, then upper.
  void (*expand)(const double* matrix, unsigned n, double* result) noexcept;
  /// The same sum for magnitudes without signs, each level times `factor` plus 2^-1000.
  void (*permanent)(const double* magnitude, unsigned n, double factor, double* result) noexcept;
  /// Whether the vertex determinants of one matrix, as computed, all exceed `error` or all stay
  /// below −error. lo, hi: n·n bounds.
  bool (*vertices_share_sign)(const double* lo, const double* hi, unsigned n,
                              double error) noexcept;

  // h_matrix_lanes.hpp

  /// v ≈ (I − P)⁻¹·1.
  void (*solve_for_ones)(const double* P, unsigned n, double* v) noexcept;
  /// Pv, to nearest.
  void (*multiply)(const double* P, const double* v, unsigned n, double* product) noexcept;
  /// Perron vectors, right and left, and the spectral radius, roughly.
  void (*perron)(const double* P, unsigned n, double* v, double* y, double* radius) noexcept;

  // inverse_lanes.hpp

  /// In place, roughly; not finite where there is none. The determinants, to nearest.
  void (*invert)(double* matrix, unsigned n, double* determinant) noexcept;

  // second_order_lanes.hpp, second_order_impact_lanes.hpp

  void (*bound_second_order)(const SecondOrderPlan& plan, const SecondOrderInput& input,
                             const SecondOrderWork& work, double* T) noexcept;
  void (*weigh_second_order)(const SecondOrderPlan& plan, const SecondOrderInput& input,
                             const SecondOrderWork& work, const double* v, const double* y,
                             double* impact) noexcept;

  // orthants_lanes.hpp

  /// For each row, in which of eight orthants its |ρ_l| may be ζ_l.
  void (*possible_rows)(const OrthantProblem& problem, unsigned first, unsigned* lanes) noexcept;
  /// Which of eight cells may hold a ρ.
  unsigned (*remaining_cells)(const OrthantProblem& problem, const OrthantCell* cells) noexcept;
};

/// Requires  supported(isa) before a function of it is called.
[[nodiscard]] const RegularityBackend& regularity_backend(Isa isa) noexcept;

/// That of the widest vectors this processor has.
[[nodiscard]] const RegularityBackend& regularity_backend() noexcept;

extern const RegularityBackend kRegularityPortable;
#if defined(__x86_64__)
extern const RegularityBackend kRegularityAvx2;
extern const RegularityBackend kRegularityAvx512;
#endif

}  // namespace regulus
