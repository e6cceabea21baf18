// SPDX-License-Identifier: Apache-2.0
// Tests the uncertain rows direction by direction.
//
// In the notation of second_order.hpp let A(t, u) be singular, v its null vector and ρ_l = Σ_k δ_k
// w_kᵀv the effect of the uncertain quantities of row l on it. Then v = −Ev − K(t)ρ and
//
//     |ρ_l| ≤ Σ_k Δ_k|w_k(t)ᵀK(t)ρ| + (Q|v|)_l,      |v| ≤ P|v| + V₀|ρ|,      V₀ ≥ |K(t)|.
//
// With ρ(P) < 1 the second gives |v| ≤ V|ρ| for any V ≥ PV + V₀, and ρ ≠ 0. Let c_k ≈ w̄_kᵀK₀ and
// let M bound the rest of Σ_k Δ_k|w_k(t)ᵀK(t)|. So A is regular all over the box unless some ρ ≠ 0
// has
//
//     |ρ_l| ≤ f_l(ρ) = Σ_k Δ_k|c_kᵀρ| + (S|ρ|)_l  for each l,      S = M + QV.
//
// The H-matrix test on T bounds |c_kᵀρ| by |c_k|ᵀ|ρ|, as if each ρ_j had its worst sign in each
// term. Here the signs are fixed: for ζ > 0, scale ρ so that |ρ| ≤ ζ with |ρ_l| = ζ_l for some l,
// and test every l and all signs of the other ρ_j (−ρ is equivalent to ρ). In each cell |ρ| is a
// box [a, b]:
//
//     - with its middle m and radius r, |c_kᵀρ| ≤ |c_kᵀm| + |c_k|ᵀr. If the bound of f_l is below
//       b_l, it is the new b_l; if it is below a_l, the cell is empty.
//     - that bound, as a function of |ρ_j| = x alone, is convex. If it is below a_l at x = a_j,
//       it stays below a_l up to where the chord to x = b_j reaches a_l: the new a_j.
//
// If there are only uncertain quantities (one pose), this comes within about one per cent of the
// true limit, and the H-matrix test within ten to twenty.
#pragma once

#include "runtime/regularity/lanes.hpp"

namespace regulus {

/// More rows would make too many cells, n·2^(n−1).
inline constexpr unsigned kMaxOrthantRows = 8;
inline constexpr unsigned kMaxOrthantForms = 96;

/// The problem of one box.
struct OrthantProblem {
  /// Terms of f_l: one form with weight Δ_k, or several whose norm has the weight (a ball).
  struct Term {
    unsigned begin, end;  ///< forms
    double weight;
  };

  unsigned rows = 0, terms = 0;
  unsigned first_term[kMaxOrthantRows + 1];         ///< of each row, and the end
  double form[kMaxOrthantForms * kMaxOrthantRows];  ///< c_k, exact as they are
  Term term[kMaxOrthantForms];
  double slack[kMaxOrthantRows * kMaxOrthantRows];  ///< S, bounds
  double reach[kMaxOrthantRows * kMaxOrthantRows];  ///< G_lj ≥ Σ_k Δ_k|c_kj|, of balls the norm
  double scale[kMaxOrthantRows];                    ///< ζ
};

/// Bit j − 1 of `orthant` is set if ρ_j < 0; ρ₀ ≥ 0. |ρ_l| = ζ_l for l = fixed.
struct OrthantCell {
  unsigned orthant, fixed;
};

/// `hint` is a cell that is likely to remain. If a cell remains, it becomes the new hint.
///
/// Requires  rows ≤ kMaxOrthantRows; S + γG for the rounding of |c_kᵀm| is in `slack`.
/// Ensures   true only if every cell is empty.
/// Rounding  upward.
[[nodiscard]] bool certain_orthants_empty(const OrthantProblem& problem,
                                          OrthantCell& hint) noexcept;

}  // namespace regulus
