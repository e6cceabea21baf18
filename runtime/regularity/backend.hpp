// SPDX-License-Identifier: Apache-2.0
// The loops of the regularity tests, compiled once per instruction set. They work in any
// rounding mode and keep no state. The files that use these functions say what the results
// prove.
#pragma once

#include "runtime/interval/isa.hpp"
#include "runtime/interval/lanes.hpp"
#include "runtime/regularity/views.hpp"

namespace regulus::detail {

struct SecondOrderPlan;
struct SecondOrderInput;
struct SecondOrderWork;
struct OrthantProblem;
struct OrthantPart;

/// The largest order for which all vertex matrices are tested.
inline constexpr std::size_t kMaxVertexOrder = 8;

/// The bounds of an interval matrix n×n in one lane.
struct BoundsOfOneLane {
  unsigned n;
  double lo[kMaxVertexOrder * kMaxVertexOrder], hi[kMaxVertexOrder * kMaxVertexOrder];
};

/// Derivatives of each entry by each variable, and the variables' radii.
struct MeanValueInput {
  ConstPointMatrix center;
  ConstIntervalMatrix derivatives;
  ConstPointVector radius;
  double factor;
  double more[kLanes];
};

struct RegularityBackend {
  // minors_lanes.hpp. Sets of columns are bit masks.

  /// Minors of the first rows, level by level: D(S) = Σ_{j∈S} ±A[|S|−1][j]·D(S∖{j}), in interval
  /// arithmetic without outward steps. determinant: one entry.
  void (*expand)(ConstIntervalMatrix matrix, IntervalVector determinant) noexcept;
  /// The same sum for magnitudes without signs, each level times `factor` plus 2^-1000.
  void (*permanent)(ConstPointMatrix magnitude, double factor, LaneNumbers& result) noexcept;
  /// Returns true if the vertex determinants of one matrix, as computed, all exceed `error`, or all
  /// are below −error.
  bool (*vertices_share_sign)(const BoundsOfOneLane& matrix, double error) noexcept;

  // h_matrix_lanes.hpp

  /// |product − I|, those on the diagonal raised for one rounding.
  void (*distance_to_identity)(ConstIntervalMatrix product, PointMatrix P) noexcept;
  /// P ← min(P, (center + Σ_k r_k·max|∂_k|)·factor + 2^-1000); `more` of each lane is added, too.
  void (*lower_to_mean_value)(const MeanValueInput& input, PointMatrix P) noexcept;
  /// v ≈ (I − P)⁻¹·1.
  void (*solve_for_ones)(ConstPointMatrix P, PointVector v) noexcept;
  /// Pv, to nearest.
  void (*multiply)(ConstPointMatrix P, ConstPointVector v, PointVector product) noexcept;
  /// Perron vectors, right and left, and the spectral radius; all approximate.
  void (*perron)(ConstPointMatrix P, PerronVectors vectors, LaneNumbers& radius) noexcept;

  // inverse_lanes.hpp

  /// Inverts in place, approximately; not finite if there is no inverse. Determinants to nearest.
  void (*invert)(PointMatrix matrix, LaneNumbers& determinant) noexcept;
  /// Rounds each row to a grid of 28 bits. Returns the lanes in which a row is too small for it, or
  /// an entry is not finite.
  LaneMask (*round_rows_to_grid)(PointMatrix matrix) noexcept;
  /// Returns the lanes in which no magnitude exceeds the limit; NaN does not count.
  LaneMask (*within)(ConstPointMatrix matrix, double limit) noexcept;
  /// ½lo + ½hi.
  void (*take_middles)(ConstIntervalMatrix matrix, PointMatrix middles) noexcept;

  // second_order_lanes.hpp, second_order_impact_lanes.hpp

  void (*bound_second_order)(const SecondOrderPlan& plan, const SecondOrderInput& input,
                             const SecondOrderWork& work, PointMatrix T) noexcept;
  void (*weigh_second_order)(const SecondOrderPlan& plan, const SecondOrderInput& input,
                             const SecondOrderWork& work, PerronVectors vectors,
                             PointVector impact) noexcept;

  // orthants_lanes.hpp

  /// Finds, for each row, in which of eight orthants its |ρ_l| may be ζ_l.
  void (*possible_rows)(const OrthantProblem& problem, unsigned first, unsigned* lanes) noexcept;
  /// Returns which of eight cells may contain a ρ.
  unsigned (*remaining_parts)(const OrthantProblem& problem, OrthantPart* parts) noexcept;
};

/// Requires  supported(isa) before a function of it is called.
[[nodiscard]] const RegularityBackend& regularity_backend(Isa isa) noexcept;

/// Returns the backend of the widest vectors that this processor has.
[[nodiscard]] const RegularityBackend& regularity_backend() noexcept;

extern const RegularityBackend kRegularityPortable;
#if defined(__x86_64__)
extern const RegularityBackend kRegularityAvx2;
extern const RegularityBackend kRegularityAvx512;
#endif

}  // namespace regulus::detail
