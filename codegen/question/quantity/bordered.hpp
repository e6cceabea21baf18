// SPDX-License-Identifier: GPL-3.0-or-later
// A bound as a question of regularity.
//
// Let J⁻¹ = D·M with M the matrix of the model and D = diag(s) its positive row scale (1 if it has
// none). For each scalar quantity q below there is a matrix B(r), whose entries are linear in r or
// in r², so that M regular and
//
//     det B(r) = det M · (1 − r·(q − y)) · (a positive factor),          y: a reference value.
//
// So if B(r) is regular for every r in [0, R], then M is regular (r = 0) and q − y ≠ 1/r for every
// such r, hence q < y + 1/R: at every pose by itself, whatever the shape of the set of poses. If it
// is regular for every r in [−R, R] and y = 0, then |q| < 1/R. And where B(r) is singular and M is
// not, q = y + 1/r is attained. The leaf tests, uncertain quantities, witnesses and certificates of
// a search apply to B as to any matrix: a load that varies touches one row only.
//
//   force in row i under w    M with row i replaced by (1 + ry)·m_i − r·wᵀ/s_i, by Cramer's rule:
//                             MᵀDF = w, so F_i = wᵀM⁻¹e_i/s_i
//   error of freedom k        M with column k replaced by (1 + ry)·m_k − r·D⁻¹δ  (M·dx = D⁻¹δ)
//   error of a part of dx     [ M  −r·D⁻¹δ ; nᵀ  1 ] with n in the unit ball: the norm is max nᵀdx
//   speed of motor i          the 1×1 matrix (1 + ry)/s_i − r·(m_i·ẋ + ρ|m_i|) for twists in a ball of
//                             radius ρ about ẋ, if the sign of r is known; a box stays uncertain
//   expression f              the 1×1 matrix 1 + ry − r·f
//   det J⁻¹ with its sign     the same, f = det D·M by its minors
//   deflection of freedom k   [ Mᵀ 0 ; −diag(1/(s²c)) M ] with column k of the second half replaced
//                             by (1 + ry)·it − r·(w, 0): f' = D·f, Mᵀf' = w, M·dx = D⁻²f'/c;
//                             transposed, so that w touches one row; the columns with Mᵀ are
//                             combined by a constant, inverse_columns.hpp
//   σ_max(J⁻¹C)               [ D⁻²  rMC ; rCM ᵀ  I ]: det = det D⁻² · det(I − r²·CMᵀD²MC)
//   σ_min(J⁻¹C)               [ D⁻²  MC ; CMᵀ  r²I ]: det = det D⁻² · det(r²I − CMᵀD²MC), so
//                             regular for every r in [0, R] shows σ_min > R; its first columns
//                             are combined likewise
//   ‖J⁻¹C‖·‖(J⁻¹C)⁻¹‖         in the maximum norm: for each row i and column k, MC with column k
//                             replaced by m_k c_k − r·h_i·y_l/s_l, h_i = s_i·Σ_j|m_ij c_j|, |y_l| ≤ 1
//
// |det J⁻¹| > α is a question of its own already: the bound is the threshold.
//
// C = diag(1 for a velocity, 1/L for an angular velocity), L the characteristic length.
#pragma once

#include <optional>
#include <string>

#include "codegen/model/request.hpp"
#include "codegen/question/quantity/quantity.hpp"

namespace regulus::detail {

/// The question of regularity for a component.
struct Bordered {
  Request request;        ///< of the matrix B
  GiNaC::matrix plain;    ///< B before its columns were combined
  std::string parameter;  ///< the name of r, a pose parameter and a motion parameter; empty: the
                          ///< threshold α takes its place, and the model is as it was
  GiNaC::ex reference;    ///< y
  bool is_two_sided = false;              ///< r is in [−R, R]; otherwise in [0, R]
  bool is_reciprocal = true;              ///< the bound is y + 1/R; otherwise it is R
  bool is_absolute = false;               ///< of |q|
  unsigned rows_of_inverse = 0;           ///< of a singular value: the rows of J⁻¹; otherwise 0
  bool has_norms = false;                 ///< of a speed: the balls of the twist enter as norms
  std::optional<GiNaC::matrix> scaled{};  ///< ±D·M if q is its determinant
  std::optional<GiNaC::matrix> combination{};  ///< of the columns, inverse_columns.hpp
};

/// Returns the question, with r in [0, 1] or [−1, 1]. Along way-points r is a parameter of the motion
/// beside that of the pieces.
///
/// Requires  `component` is of request.model; reference = 0 if the component is absolute. It is not
///           kCondition2, which has no such matrix.
/// Ensures   row scales, threshold and notes of the model are gone.
[[nodiscard]] Bordered border(const Request& request, const Component& component,
                              const GiNaC::ex& reference = 0);

/// Returns the question whether q < limit (of a least value: > limit) everywhere, with r in all of
/// the range where B must be regular; of a determinant: with the limit as the threshold.
///
/// Requires  as border(); limit > 0 if the component is absolute.
[[nodiscard]] Bordered border_at_limit(const Request& request, const Component& component,
                                       const GiNaC::ex& limit);

}  // namespace regulus::detail
