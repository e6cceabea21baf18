// SPDX-License-Identifier: GPL-3.0-or-later
// Constant combinations of the columns of Aᵀ that a search can bound as well as A.
//
// A search multiplies a matrix from the left by K, its approximate inverse at the middle of a box.
// For A this leaves K·ΔA; for Aᵀ, a block of some matrices B(r), it leaves A⁻ᵀ·ΔAᵀ, the transpose
// of ΔA·A⁻¹. The two have different spectral radii: for a hexapod of the library 0.22 and 7.8 over
// the same box, as anchors far from the origin turn small changes of the directions of legs into
// large moments. With a constant C ≈ A₀⁻ᵀ from one pose, (AᵀC)⁻¹·ΔAᵀ·C = C⁻¹·(A⁻ᵀ·ΔAᵀ)·C, and
// C⁻¹·A⁻ᵀ ≈ I, so it is close to ΔAᵀ·A⁻ᵀ = (A⁻¹·ΔA)ᵀ: 0.22 again.
//
// A regular constant C changes neither where a matrix is singular nor where it is defined.
#pragma once

#include <optional>

#include "codegen/model/request.hpp"

namespace regulus::detail {

/// Returns a regular m×m matrix C of short exact numbers, so that AᵀC ≈ [I 0] at a pose of the
/// motion, the middle if possible; nullopt if there is none at the poses that were tried.
///
/// Shape     A: m×n with m ≥ n, in the symbols of `request`.
/// Ensures   the same C in every run; det C ≠ 0 by exact arithmetic.
[[nodiscard]] std::optional<GiNaC::matrix> inverse_columns(const Request& request,
                                                           const GiNaC::matrix& A);

}  // namespace regulus::detail
