// SPDX-License-Identifier: Apache-2.0
// The H-matrix test: if P ≥ |B − I|, v > 0 and Pv < v, then B is regular, for every B that P
// bounds. Proof: Pv < v gives ρ(|B − I|) ≤ ρ(P) < 1, so B = I − (I − B) has no null vector.
//
// P, v, y are in point layout, n×n row-major and n; n ≤ kMaxOrder. Lanes whose input is not
// finite come out undecided, never certified.
#pragma once

#include "regulus/regularity/lanes.hpp"

namespace regulus {

/// P ≥ |B − I| for every B between the bounds.
///
/// Shape     product n×n in interval layout.
/// Ensures   |B[i][j] − δᵢⱼ| ≤ P[i][j] for every B[i][j] in product[i][j].
/// Rounding  upward.
void distance_to_identity_ru(const double* product, std::size_t n, double* P) noexcept;

/// Lowers P to the mean-value bound C + Σ_k mag(D_k)·r_k wherever that is smaller.
///
/// Shape     center, P: n×n, point layout. derivatives: `variables` matrices n×n, interval layout.
///           radius: `variables`, point layout.
/// Requires  C ≥ |B(t₀) − I|; D_k encloses ∂_kB over a convex set that holds t and t₀; |t − t₀|_k ≤
///           r_k; P bounds |B(t) − I| in the lanes of `lanes` or is +∞.
/// Ensures   P still bounds |B(t) − I|. Lanes outside `lanes` keep their P.
/// Rounding  upward.
/// Source    Neumaier, Interval Methods for Systems of Equations, §2.3.
void lower_to_mean_value_ru(const double* center, const double* derivatives, const double* radius,
                            std::size_t n, std::size_t variables, LaneMask lanes,
                            double* P) noexcept;

/// The lanes in which P proves regularity. v = (I − P)⁻¹·1 approximately: for ρ(P) < 1 it is
/// positive and Pv = v − 1 < v, so the test loses nothing but rounding.
///
/// Ensures   in each returned lane v > 0 and Pv < v hold for the exact real product.
/// Rounding  v to nearest, Pv upward.
[[nodiscard]] LaneMask certain_h_matrix(const double* P, std::size_t n, double* v) noexcept;

/// Whether 0 < v and Pv < v, for a given v.
[[nodiscard]] LaneMask certain_contraction(const double* P, const double* v,
                                           std::size_t n) noexcept;

/// A lower bound of |det B| by elimination on I − P, the comparison matrix of the worst B.
///
/// Ensures   lower[lane] ≤ |det B| for every B with |B − I| ≤ P; 0 where nothing was proved.
/// Rounding  downward.
/// Source    Ostrowski: |det B| ≥ det⟨B⟩ for H-matrices, and det⟨B⟩ falls as P grows.
void determinant_rd(const double* P, std::size_t n, double* lower) noexcept;

/// An upper bound of |det B| from the row sums weighted by v, ∏(1 + (Pv)ᵢ/vᵢ).
///
/// Requires  v > 0.
/// Ensures   |det B| ≤ upper[lane] for every B with |B − I| ≤ P.
/// Rounding  upward.
/// Source    Hadamard: |det C| ≤ ∏ Σⱼ|Cᵢⱼ|, for C = diag(v)⁻¹·B·diag(v).
void determinant_ru(const double* P, const double* v, std::size_t n, double* upper) noexcept;

/// Right and left Perron vectors and the spectral radius of P, roughly; they steer bisection only.
void approx_perron(const double* P, std::size_t n, double* v, double* y,
                   double* approx_radius) noexcept;

}  // namespace regulus
