// SPDX-License-Identifier: Apache-2.0
// Bounds of second order, by a preconditioner that moves with the pose.
//
// Let t be the variables that touch several rows ("wide"), τ = t − t₀, |τ_p| ≤ r_p, and u the
// uncertain quantities that touch one row only, δ = u − ū, |δ_k| ≤ Δ_k. With K₀ ≈ A(t₀, ū)⁻¹, B(t)
// = K₀A(t, ū) and point matrices D_p ≈ ∂_pB(t₀) let
//
//     K(t) = (I − Σ_p τ_pD_p)K₀,      E(t) = K(t)A(t, ū) − I = (I − Σ_p τ_pD_p)B(t) − I.
//
// Taylor's theorem, B(t) = B + Σ_p τ_pB_p + ½ Σ_pq τ_pτ_qB_pq with B_pq enclosed by ∂_p∂_qB over
// the box, leaves no first-order term in E except rounding. With B = I + e, B_p = D_p + d_p:
//
//     E = e + Σ_p τ_p(d_p − D_pe) + Σ_pq τ_pτ_q(½B_pq − D_pD_q − D_pd_q)
//         − ½ Σ_s τ_sD_s Σ_pq τ_pτ_qB_pq.
//
// The uncertain quantities: by the mean value theorem A(t, u) = A(t, ū) + Σ_k δ_k e_l(k) w_kᵀ with
// w_k in an enclosure of ∂_{u_k}A's row l(k). K(t)A(t, u) is the Schur complement of
//
//     B = [ I + E             K(t) ]     one column and one row more for each row touched.
//         [ −Σ_k δ_k w_kᵀ     I    ]
//
// Adding δ_k w_k(t)ᵀ times the upper rows to the lower ones, for any vectors w_k(t), does not
// change the determinant, and changes the lower rows to
//
//     [ Σ_k δ_k(w_k(t)ᵀE − (w_k − w_k(t))ᵀ)     I + Σ_k δ_k w_k(t)ᵀK(t) ].
//
// w_k(t) = w̄_k + Σ_p τ_pg_kp, w̄_k ≈ ∂_{u_k}A(t₀, ū) and g_kp in the middle of its ∂_p over the box,
// makes the last block vary with t as the truth does, to first order:
//
//     w_k(t)ᵀK(t) = w̄_kᵀK₀ + Σ_p τ_p(g_kpᵀ − w̄_kᵀD_p)K₀ − Σ_pq τ_pτ_q g_kpᵀD_qK₀.
//
// So det K(t)A(t, u) = det B and |B − I| ≤ T, sums over the k that touch row l:
//
//     T = [ P  |K₀| + Σ_p r_p|D_pK₀| ]     Q_lj = Σ_k Δ_k(|w_k(t)|ᵀP + |w_k − w_k(t)|ᵀ)_j
//         [ Q            R           ]     R_lj = Σ_k Δ_k|w_k(t)ᵀK(t)|_j
//
// The coordinates of a point in a ball of radius ρ, ‖δ‖ ≤ ρ, contribute ρ·‖x‖ instead of
// Δ·Σ_k|x_k|.
//
// The H-matrix test and its bounds of determinants then apply to T.
#pragma once

#include "runtime/regularity/aligned_buffer.hpp"
#include "runtime/regularity/backend.hpp"
#include "runtime/regularity/orthants.hpp"
#include "runtime/regularity/second_order_lists.hpp"

namespace regulus::detail {

struct SecondOrderOptions {
  static constexpr std::size_t kAllVariables = static_cast<std::size_t>(-1);
  /// K and w_k move with the variables before this one. For others D_p = 0 and g_kp = 0; the
  /// derivation allows any values. P is then of first order in them.
  std::size_t moving = kAllVariables;
  /// True if approx_impact is called.
  bool keeps_shares = true;
  /// True if approx_impact must also estimate variables with a row.
  bool weighs_row_variables = false;
};

class SecondOrderBounds {
 public:
  /// Requires  places as documented: a variable that `structure` gives a row is listed with it.
  SecondOrderBounds(const DerivativeLists& lists, const RowStructure& structure,
                    const SecondOrderOptions& options,
                    const RegularityBackend& backend = regularity_backend());
  SecondOrderBounds(const SecondOrderBounds&) = delete;
  SecondOrderBounds& operator=(const SecondOrderBounds&) = delete;

  /// Returns n plus one for each touched row.
  [[nodiscard]] std::size_t order() const noexcept { return plan_.columns_of_A + plan_.slots; }

  /// Ensures   T, of order order(), bounds |B − I| all over each box; an entry that cannot be
  ///           bounded is not finite.
  /// Rounding  upward.
  void bound_ru(const SecondOrderInput& input, PointMatrix T) noexcept;

  /// Returns an upper bound of |det K(t)|/|det K₀| over each box, after bound_ru. To first order it
  /// grows with the traces of the D_p only.
  ///
  /// Ensures   |det K(t)| ≤ |det K₀|·result[lane] for every t of the box; +∞ where none was found.
  /// Rounding  upward.
  /// Source    |ln|det(I + X)| − tr X| ≤ f²/(2 − 2f) for ‖X‖_F ≤ f < 1, as |tr Xʲ| ≤ ‖X‖_Fʲ.
  [[nodiscard]] LaneNumbers moving_determinant_ru(const SecondOrderInput& input) const noexcept;

  /// Returns the lanes in which A is regular because no direction of the uncertain rows can make it
  /// singular, after bound_ru with this T; runtime/regularity/orthants.hpp.
  ///
  /// Shape     guess: order() entries, positive; its lower part is used, the likely magnitudes of
  ///           the |ρ_l|. hint: a cell that remained before. halvings: if not 0, products of
  ///           uncertain quantities become forms if necessary, and so many parts may be halved.
  /// Ensures   in each returned lane, a subset of `lanes`: A is regular all over the box.
  [[nodiscard]] LaneMask certain_by_orthants(const SecondOrderInput& input, ConstPointMatrix T,
                                             ConstPointVector guess, LaneMask lanes,
                                             unsigned halvings, OrthantCell& hint) const noexcept;

  /// Computes roughly what each variable adds to yᵀTv, after bound_ru.
  ///
  /// Requires  keeps_shares.
  void approx_impact(const SecondOrderInput& input, PerronVectors vectors,
                     PointVector impact) const noexcept;

 private:
  const RegularityBackend& backend_;
  const SecondOrderLists lists_;
  AlignedBuffer numbers_;
  SecondOrderPlan plan_;
  SecondOrderWork work_;
};

}  // namespace regulus::detail
