// SPDX-License-Identifier: Apache-2.0
// Uncertain quantities that touch one row of the matrix only: regularity for all their values at
// once, without bisecting them.
//
// Let u_k touch row l(k), so that ∂_kA = e_l w_kᵀ, and let KA(t, u₀) = I + E with |E| ≤ P. By the
// mean value theorem A(t, u) = A(t, u₀) + Σ_k δ_k e_l(k) w_kᵀ, |δ_k| ≤ Δ_k, w_k within its
// enclosure. KA(t, u) is the Schur complement of
//
//     B = [ I + E             K ]        one column and one row more for each row touched.
//         [ −Σ_k δ_k w_kᵀ     I ]
//
// For any vectors w_k⁰, adding δ_k w_k⁰ᵀ times the upper rows to the lower ones leaves the
// determinant as it is and turns the lower rows into
//
//     [ Σ_k δ_k (w_k⁰ᵀE − (w_k − w_k⁰)ᵀ)     I + Σ_k δ_k w_k⁰ᵀK ]
//
// so that det KA = det B and |B − I| ≤ T with
//
//     T = [ P  |K| ]     Q_lj = Σ_k Δ_k ( |w_k⁰ᵀE|_j + |w_k − w_k⁰|_j )
//         [ Q   R  ]     R_lj = Σ_k Δ_k |w_k⁰ᵀK|_j           (sums over the k that touch row l)
//
// The H-matrix test and its bounds of determinants then apply to T.
#pragma once

#include <vector>

#include "regulus/regularity/lanes.hpp"

namespace regulus {

/// Which variables touch one row only.
struct RowStructure {
  static constexpr int kWide = -1;
  std::vector<int> slot;          ///< for each variable: an index into rows, or kWide
  std::vector<std::size_t> rows;  ///< the rows touched

  [[nodiscard]] bool empty() const noexcept { return rows.empty(); }
  [[nodiscard]] bool touches_one_row(std::size_t variable) const noexcept {
    return !slot.empty() && slot[variable] != kWide;
  }
};

/// What T is made of. Bounds of derivatives are those of K·∂_kA, `variables` matrices n×n in
/// interval layout; everything else is in point layout.
struct StructuredInput {
  std::size_t m, n, variables;
  const double* P;         ///< n×n, ≥ |KA(t, u₀) − I| over the box
  const double* center;    ///< n×n, ≥ |KA(t₀, u₀) − I|
  const double* K;         ///< n×m
  const double* nominal;   ///< derivatives over the box with u = u₀
  LaneMask nominal_lanes;  ///< where they are defined; elsewhere P alone bounds E
  const double* full;      ///< derivatives over the box and all u
  const double* radius;    ///< of each variable
  double* workspace;       ///< variables·n², point layout, overwritten
};

/// T, of order n + structure.rows.size().
///
/// Ensures   T bounds |B − I| for every B above, in the lanes where all input is defined; an entry
///           that cannot be bounded is not finite.
/// Rounding  upward.
/// Source    Merlet, T-RO 2007, §IV, poses the problem.
void structured_bounds_ru(const RowStructure& structure, const StructuredInput& input,
                          double* T) noexcept;

}  // namespace regulus
