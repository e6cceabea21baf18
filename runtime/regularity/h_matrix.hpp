// SPDX-License-Identifier: Apache-2.0
// The H-matrix test: if P ≥ |B − I|, v > 0 and Pv < v, then B is regular, for every B that P
// bounds. Proof: Pv < v gives ρ(|B − I|) ≤ ρ(P) < 1, so B = I − (I − B) has no null vector.
//
// P is n×n, v and y have n entries; n ≤ kMaxOrder. Lanes whose input is not finite are undecided,
// never certified.
#pragma once

#include "runtime/regularity/lanes.hpp"
#include "runtime/regularity/views.hpp"

namespace regulus::detail {

/// Computes P ≥ |B − I| for every B between the bounds.
///
/// Ensures   |B[i][j] − δᵢⱼ| ≤ P[i][j] for every B[i][j] in product[i][j].
/// Rounding  upward.
void distance_to_identity_ru(ConstIntervalMatrix product, PointMatrix P) noexcept;

/// Lowers P to the mean-value bound C + Σ_k mag(D_k)·r_k where that is smaller.
///
/// Shape     center, P: n×n. derivatives: a row for each variable, the entries of D_k. radius: an
///           entry for each variable.
/// Requires  C ≥ |B(t₀) − I|; D_k encloses ∂_kB over a convex set that holds t and t₀; |t − t₀|_k ≤
///           r_k; P bounds |B(t) − I| in the lanes of `lanes` or is +∞.
/// Ensures   P still bounds |B(t) − I|. Lanes outside `lanes` keep their P.
/// Rounding  upward.
/// Source    Neumaier, Interval Methods for Systems of Equations, §2.3.
void lower_to_mean_value_ru(ConstPointMatrix center, ConstIntervalMatrix derivatives,
                            ConstPointVector radius, LaneMask lanes, PointMatrix P) noexcept;

/// Returns the lanes in which P proves regularity. v = (I − P)⁻¹·1 approximately: for ρ(P) < 1 it
/// is positive and Pv = v − 1 < v, so the test loses nothing but rounding.
///
/// Ensures   in each returned lane v > 0 and Pv < v hold for the exact real product.
/// Rounding  v to nearest, Pv upward.
[[nodiscard]] LaneMask certain_h_matrix(ConstPointMatrix P, PointVector v) noexcept;

/// Returns the lanes in which 0 < v and Pv < v, for a given v.
[[nodiscard]] LaneMask certain_contraction(ConstPointMatrix P, ConstPointVector v) noexcept;

/// Returns a lower bound of |det B| by elimination on I − P, the comparison matrix of the worst B.
///
/// Ensures   result[lane] ≤ |det B| for every B with |B − I| ≤ P; 0 where nothing was proved.
/// Rounding  downward.
/// Source    Ostrowski: |det B| ≥ det⟨B⟩ for H-matrices, and det⟨B⟩ falls as P grows.
[[nodiscard]] LaneNumbers determinant_rd(ConstPointMatrix P) noexcept;

/// Returns an upper bound of |det B| from the row sums weighted by v, ∏(1 + (Pv)ᵢ/vᵢ).
///
/// Requires  v > 0.
/// Ensures   |det B| ≤ result[lane] for every B with |B − I| ≤ P.
/// Rounding  upward.
/// Source    Hadamard: |det C| ≤ ∏ Σⱼ|Cᵢⱼ|, for C = diag(v)⁻¹·B·diag(v).
[[nodiscard]] LaneNumbers determinant_ru(ConstPointMatrix P, ConstPointVector v) noexcept;

/// Returns roughly the spectral radius of P, and its Perron vectors in `vectors`. They are used for
/// bisection only.
[[nodiscard]] LaneNumbers approx_perron(ConstPointMatrix P, PerronVectors vectors) noexcept;

}  // namespace regulus::detail
