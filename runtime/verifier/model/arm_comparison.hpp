// SPDX-License-Identifier: Apache-2.0
// Decides how the matrix of a certificate is related to the Jacobian of an arm.
#pragma once

#include "runtime/verifier/ball.hpp"
#include "runtime/verifier/model/chain_view.hpp"

namespace regulus::verifier {

/// Shows that full rank of the certificate's matrix is full rank of the Jacobian at every pose, and
/// that its determinant is the Jacobian's if there is a threshold: PROOF.md, "Serial arms".
///
/// Throws OtherModel, by SectionComparer::refuse, if a point shows the contrary; otherwise leaves it
/// out, with a reason.
void compare_arm(SectionComparer& comparer, const std::vector<ChainJoint>& chain,
                 std::size_t columns);

/// Returns a point of the ranges; other numbers give other ones.
[[nodiscard]] std::vector<Ball> some_point(const Question& question, int number, long bits);

}  // namespace regulus::verifier
