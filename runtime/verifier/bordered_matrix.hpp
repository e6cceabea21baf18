// SPDX-License-Identifier: Apache-2.0
// The question of regularity that proves a bound of a quantity. PROOF.md, "Bounds of quantities",
// derives the matrices. The condition number in the 2-norm has a question of its own.
#pragma once

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Returns true for a bound of the condition number in the 2-norm. Its matrix is X = J⁻¹·diag(factors)
/// itself, and its claim is that about X.
[[nodiscard]] bool is_about_ratio(const QuantityLines& quantity);

/// Puts the matrix B of the bound in place of the matrix of the model, and adds its variables: r
/// after the parameters, those of the load, the twist, the errors or the directions after the
/// uncertain quantities. No expression of the question has these variables.
///
/// Ensures   unless is_about_ratio(): the claim NO SINGULARITY about the new question implies the bound. The claim
///           SINGULARITY implies that it is attained, if also the matrix of the model is regular at
///           that point or needs_regular_model() is false.
/// Throws    Rejection if there are too many variables.
void border(Question& question);

/// Returns true if a singular B means that the quantity has a value only where the matrix of the
/// model is regular.
[[nodiscard]] bool needs_regular_model(const QuantityLines& quantity);

}  // namespace regulus::verifier
