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
//     - the largest f_l for |ρ_j| = x, as a function of x alone, is convex. If a bound of it is
//       below a_l at x = a_j, it stays below a_l up to where the chord to x = b_j reaches a_l: the
//       new a_j.
//     - what remains can be halved, and its parts be tested.
//
// Wide tolerances have effects of second order, products δ_jδ_k in a row. In S they count as if
// each had its worst sign in each entry of v. They can be forms, too: by Taylor's theorem at fixed
// t,
//
//     ρ_l = Σ_k δ_k ∂_kA_l(t, ū)v + Σ_{j<k} δ_jδ_k H_jkᵀv + ½ Σ_k δ_k² H_kkᵀv,
//
// with H_jk in an enclosure of ∂_j∂_kA_l over the box. With H̄_jk in its middle, H_jkᵀv =
// −H̄_jkᵀ(Ev + K(t)ρ) + (H_jk − H̄_jk)ᵀv, so the terms Δ_jΔ_k|c_jkᵀρ|, c_jk ≈ H̄_jkᵀK₀, replace what
// S has for them; S keeps Δ_jΔ_k times |H̄_jk|ᵀΣ_p r_p|D_pK₀| in M, and |H̄_jk|ᵀP + |H_jk − H̄_jk|ᵀ
// in Q. Within one ball ½|Σ_jk δ_jδ_k x_jk| ≤ ½ρ²‖x‖_F. Other products and what they multiply make
// one term: with σ = sign ρ_l and −σδ in the place of δ,
//
//     |ρ_l| ≤ max over δ of Σ_k δ_k c_kᵀρ − σ Σ_{j<k} δ_jδ_k c_jkᵀρ.
//
// This is sublinear in ρ, so a bound at m and G for the rest bound it over the cell. It is attained
// at ends of ranges: those of up to three quantities are tried, and for each choice the others
// contribute magnitudes. For points in two balls see coupled_lanes.hpp. If a ball has products with
// several others, |Σ_jk δ_jδ_k x_jk| ≤ ρ_1ρ_2‖x‖₂. Product forms cost several times as much, so they
// are used on demand.
//
// If there are only uncertain quantities (one pose), in ranges, and the cells are halved, this
// decides which limit is the true one: rows do not share quantities, and by continuity ρ_l takes
// every value up to f_l. The H-matrix test comes within ten to twenty per cent of it.
#pragma once

#include <cstdint>

#include "runtime/regularity/lanes.hpp"

namespace regulus::detail {

/// More rows would make too many cells, n·2^(n−1).
inline constexpr unsigned kMaxOrthantRows = 8;
inline constexpr unsigned kMaxOrthantForms = 256;
/// The most quantities of a coupled term: those whose ends are tried, the others, and those of a ball.
inline constexpr unsigned kMaxEndsTried = 3, kMaxCoupled = 8, kMaxOfBall = 3;
inline constexpr unsigned kMaxCoupledForms = kMaxEndsTried * (kMaxCoupled + 1) + kMaxCoupled;

/// The problem of one box.
struct OrthantProblem {
  /// A term of f_l.
  struct Term {
    enum class Kind : std::uint8_t {
      kNorm,    ///< weight·|x|, or weight times the Euclidean norm of several forms
      kMatrix,  ///< weight times the spectral norm of a 3×3 matrix, row-major
      kRanges,  ///< max over |s_i| ≤ 1, |t_j| ≤ 1 of sᵀx + tᵀy − σ·tᵀZs
      kBalls,   ///< the same over ‖s‖ ≤ 1, ‖t‖ ≤ 1; weights are in the forms
    };
    unsigned begin, end;  ///< forms; of the last two kinds: x, y, Z row-major
    double weight;
    Kind kind = Kind::kNorm;
    unsigned first = 0, second = 0;  ///< entries of x, of y
  };

  unsigned rows = 0, terms = 0;
  unsigned first_term[kMaxOrthantRows + 1];         ///< of each row, and the end
  double form[kMaxOrthantForms * kMaxOrthantRows];  ///< c_k, exact as they are
  Term term[kMaxOrthantForms];
  double slack[kMaxOrthantRows * kMaxOrthantRows];  ///< S, bounds
  /// G_lj: the sum over the terms of the weight times the norm of the forms' j-th coefficients;
  /// |·|₁ of kRanges, ‖x‖ + ‖y‖ + ‖Z‖_F of kBalls. So f_l(ρ + r) ≤ f_l(ρ) + (G|r|)_l + (S|r|)_l.
  double reach[kMaxOrthantRows * kMaxOrthantRows];
  double scale[kMaxOrthantRows];  ///< ζ
};

/// Bit j − 1 of `orthant` is set if ρ_j < 0; ρ₀ ≥ 0. |ρ_l| = ζ_l for l = fixed.
struct OrthantCell {
  unsigned orthant, fixed;
};

/// The part of a cell where low_j ≤ |ρ_j| ≤ high_j.
struct OrthantPart {
  unsigned orthant;
  double low[kMaxOrthantRows], high[kMaxOrthantRows];
};

/// `hint` is a cell that is likely to remain. If a cell remains, it becomes the new hint. The result
/// does not depend on it. At most `halvings` parts are halved.
///
/// Requires  rows ≤ kMaxOrthantRows; S + γG for the rounding of |c_kᵀm| is in `slack`.
/// Ensures   true only if every cell is empty.
/// Rounding  upward.
[[nodiscard]] bool certain_orthants_empty(const OrthantProblem& problem, OrthantCell& hint,
                                          unsigned halvings = 0) noexcept;

}  // namespace regulus::detail
