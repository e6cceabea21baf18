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
// the box, leaves nothing of first order in E but rounding. With B = I + e, B_p = D_p + d_p:
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
// Adding δ_k w_k(t)ᵀ times the upper rows to the lower ones, for any vectors w_k(t), leaves the
// determinant as it is and turns the lower rows into
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

#include <utility>
#include <vector>

#include "regulus/regularity/octet.hpp"

namespace regulus {

/// Which variables touch one row only.
struct RowStructure {
  static constexpr int kWide = -1;
  std::vector<int> slot;          ///< for each variable: an index into rows, or kWide; or empty
  std::vector<std::size_t> rows;  ///< the rows touched
  /// For each variable: the number of the ball whose coordinate it is, or kNoBall; empty if there
  /// are none. The radius of such a variable is that of its ball.
  std::vector<int> ball = {};
  static constexpr int kNoBall = -1;

  /// Whether anything was found out about the variables.
  [[nodiscard]] bool is_known() const noexcept { return !slot.empty(); }
  [[nodiscard]] bool empty() const noexcept { return rows.empty(); }
  [[nodiscard]] bool touches_one_row(std::size_t variable) const noexcept {
    return !slot.empty() && slot[variable] != kWide;
  }
};

/// The derivative of an entry by `first`, and also by `second` ≥ first if its order is two.
struct DerivativePlace {
  std::size_t row, column, first, second;
};

/// What is not listed is zero.
struct DerivativeLists {
  std::size_t rows = 0, columns = 0, variables = 0;
  std::vector<DerivativePlace> first, second;          ///< of B, by wide variables
  std::vector<DerivativePlace> row_first, row_second;  ///< of A, by at least one with a row
};

/// Values for eight boxes, in the layouts of regulus/regularity/lanes.hpp.
struct SecondOrderInput {
  const double* K;           ///< n×m, points
  const double* product;     ///< B(t₀), n×n, intervals
  const double* first;       ///< at (t₀, ū), intervals
  const double* second;      ///< over the boxes, intervals
  const double* row_first;   ///< at (t₀, ū), intervals
  const double* row_second;  ///< over the boxes, intervals
  const double* radius;      ///< r_p, Δ_k: of each variable, points
};

class SecondOrderBounds {
 public:
  /// Requires  places as documented: a variable that `structure` gives a row is listed with it.
  /// Ensures   `moves` false: D_p = 0 and g_kp = 0, which the derivation allows like any others; K
  ///           and w_k then stay as they are at t₀, and P is of first order.
  SecondOrderBounds(const DerivativeLists& lists, const RowStructure& structure, bool moves = true);

  /// n, and one more for each row touched.
  [[nodiscard]] std::size_t order() const noexcept { return columns_ + touched_.size(); }

  /// Ensures   T, of order order(), bounds |B − I| all over each box; an entry that cannot be
  ///           bounded is not finite.
  /// Rounding  upward.
  void bound_ru(const SecondOrderInput& input, double* T) noexcept;

  /// An upper bound of |det K(t)|/|det K₀| over each box, after bound_ru. To first order it grows
  /// with the traces of the D_p only.
  ///
  /// Ensures   |det K(t)| ≤ |det K₀|·upper[lane] for every t of the box; +∞ where none was found.
  /// Rounding  upward.
  /// Source    |ln|det(I + X)| − tr X| ≤ f²/(2 − 2f) for ‖X‖_F ≤ f < 1, as |tr Xʲ| ≤ ‖X‖_Fʲ.
  void moving_determinant_ru(double* upper) const noexcept;

  /// Roughly what each variable adds to yᵀTv, after bound_ru; points.
  void approx_impact(const double* v, const double* y, double* impact) noexcept;

 private:
  struct Entry {
    std::size_t row, column, at;  ///< `at`: in the list it comes from
  };
  using Entries = std::vector<Entry>;
  struct WideVariable {
    std::size_t variable;
    Entries first;
    OctetMatrix D, DK;      ///< D_p, D_pK₀
    OctetMatrix defect, R;  ///< what it adds to P and to R
  };
  struct Pair {
    std::size_t p, q;  ///< of wide variables, p ≤ q
    Entries second;
  };
  struct RowVariable {
    std::size_t variable, slot;
    Entries first;
    std::vector<Entries> mixed;                             ///< by wide variable
    std::vector<std::pair<std::size_t, Entries>> same_row;  ///< by itself and those before it
    OctetMatrix R;                                          ///< its part of row `slot` of R
  };

  using Group = std::vector<std::size_t>;  ///< indices of row variables

  void group_row_variables(const RowStructure& structure);
  void list_wide(const DerivativeLists& lists, const RowStructure& structure);
  void list_rows(const DerivativeLists& lists, const RowStructure& structure);
  [[nodiscard]] std::size_t wide_index(std::size_t variable);
  [[nodiscard]] RowVariable& row_variable(std::size_t variable, const RowStructure& structure);

  void read_center(const SecondOrderInput& input) noexcept;
  void add_second_order(const SecondOrderInput& input) noexcept;
  void add_pair(const SecondOrderInput& input, const Pair& pair) noexcept;
  void bound_defect() noexcept;
  static void accumulate(Octet& sum, const Octet& x, bool ball) noexcept;
  static void finish(OctetMatrix& sums, bool ball) noexcept;
  void bound_group(const SecondOrderInput& input, const Group& group) noexcept;
  void read_row_variable(const SecondOrderInput& input, const RowVariable& u) noexcept;
  void add_group(std::size_t slot, const Octet& range, RowVariable* single) noexcept;
  void bound_rows() noexcept;
  void assemble(double* T) const noexcept;

  std::size_t rows_, columns_;
  bool moves_;
  std::vector<WideVariable> wide_;
  std::vector<Pair> pairs_;
  std::vector<RowVariable> row_variables_;
  std::vector<Group> groups_;         ///< one variable, or the coordinates of a point in a ball
  std::vector<std::size_t> touched_;  ///< rows, by slot

  // For one batch. A sum over p has the weights r_p, over p, q the weights r_pr_q.
  std::vector<Octet> radius_;                 // of each variable
  OctetMatrix K_, abs_K_, sum_DK_;            // n×m
  OctetMatrix e_, sum_d_, sum_D_;             // n×n
  OctetMatrix radius_of_B_, magnitude_of_B_;  // n×n: ½ Σ_pq of ∂_p∂_qB
  OctetMatrix pair_, P_;                      // n×n
  OctetMatrix weight_, weight_of_g_, rest_;   // slots×n: Σ_k Δ_k of |w̄_k|, Σ_p r_p|g_kp|, …
  OctetMatrix R_;                             // slots×slots
  OctetMatrix row_, slope_;                   // 1×n: w̄_k; wide×n: g_kp
  OctetMatrix columns_of_group_, R_of_group_;  // (1 + wide)×n and (1 + wide)×slots
};

}  // namespace regulus
