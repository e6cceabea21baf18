// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds the condition number κ = σ_max/σ_min of a matrix over a box.
//
// A: m×n, m ≥ n. U, V: any m×m and n×n matrices, here the approximate singular vectors at the
// centre c of the box. With |UᵀU − I| ≤ ε < 1, |VᵀV − I| ≤ ε' < 1 and B = UᵀAV,
//
//     κ(A) ≤ κ(B)·√((1 + ε)(1 + ε')/((1 − ε)(1 − ε'))).
//
// Near c, B is almost diagonal. Let b_i(x) = d_i + Σ_k g_ik·δ_k ± e_i be its diagonal, δ = x − c,
// |δ_k| ≤ r_k, and o_ij a bound of |b_ij| over the box, i ≠ j (rotated_boxes.hpp). Take positive
// vectors y of n and z of m components.
//
// σ_max(B) ≤ s if |B|y ≤ s·z and |B|ᵀz ≤ s·y, because then |B|ᵀ|B|y ≤ s²y, and the spectral radius of
// the nonnegative |B|ᵀ|B| is at most s² (Collatz and Wielandt).
//
// σ_min(B) ≥ μ > 0 if ⟨B⟩y ≥ μ·z and ⟨B⟩ᵀz ≥ μ·y. Here ⟨B⟩ is the comparison matrix of the first n
// rows, with |b_i| on the diagonal and −|b_ij| beside it, and y and z are other vectors than above.
// For N = ⟨B⟩⁻¹ ≥ 0 then Nz ≤ y/μ and Nᵀy ≤ z/μ, so NᵀNz ≤ z/μ², and |B⁻¹| ≤ N (Ostrowski) has a
// norm of at most 1/μ.
//
// So every row i and every column i gives one bound, all of the same form:
//
//     s(x) = max (α_i·b_i(x) + β_i),  α_i = y_i/z_i,  β_i = Σ_j o_ij·y_j/z_i   of rows,
//     μ(x) = min (α_l·b_l(x) − β_l)   with others,    and with z in the place of y for columns.
//
// Both depend on the same δ. So κ(B) < T all over the box if μ > 0 and if for all of these bounds
//
//     α_i·(d_i + e_i) + β_i − T·(α_l·(d_l − e_l) − β_l) + Σ_k |α_i·g_ik − T·α_l·g_lk|·r_k < 0.
//
// A factor that all singular values have in common, which changes with the pose, cancels here. For
// an isolated singular value, good weights make β as small as the square of the box. The least T is
// found by Newton's method on these functions of T, which are convex and decreasing; the
// inequalities are then proved.
#pragma once

#include <span>
#include <vector>

#include "codegen/question/condition/rotated_boxes.hpp"

namespace regulus::detail {

/// A bound of κ over a box.
struct ConditionBound {
  double upper = kInfinity;      ///< κ < upper for every matrix of the box
  std::vector<double> impact{};  ///< roughly what each variable adds to the excess; may be empty
  std::vector<double> growth{};  ///< roughly the slopes of log κ at c; may be empty
};

/// Requires  every value that A takes is in `box`; at most 64 rows.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] ConditionBound bound_condition(const RotatedBox& box);

}  // namespace regulus::detail
