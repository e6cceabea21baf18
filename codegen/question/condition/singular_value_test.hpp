// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds the largest or the least singular value of a matrix over a box.
//
// B = UᵀAV, b_i, o_ij, e_i and the bounds of σ(B) by weights are those of condition_test.hpp. Over the box
// |b_i| ≤ |d_i| + e_i + Σ_k |g_ik|·r_k, and so
//
//     σ_max(B) ≤ max (α_i·(|d_i| + e_i + Σ_k |g_ik|·r_k) + β_i),
//     σ_min(B) ≥ min (α_l·(d_l − e_l − Σ_k |g_lk|·r_k) − β_l)    if that is positive,
//
// where each b_l is positive. σ(A) follows by Distortion.
#pragma once

#include <vector>

#include "codegen/question/condition/rotated_boxes.hpp"

namespace regulus::detail {

enum class Extreme { kLargest, kLeast };

struct SingularValueBound {
  /// σ_max ≤ value, or σ_min ≥ value, for every matrix of the box; infinite, or 0: it has no bound.
  double value;
  std::vector<double> impact{};  ///< roughly what each variable adds to the excess; may be empty
  std::vector<double> growth{};  ///< roughly the slopes of log σ at c; may be empty
};

/// Requires  every value that A takes is in `box`; at most 64 rows.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] SingularValueBound bound_singular_value(const RotatedBox& box, Extreme extreme);

}  // namespace regulus::detail
