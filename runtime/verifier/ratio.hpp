// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "runtime/verifier/ball.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Returns true only if A, given row by row, is singular, or its condition number in the 2-norm is
/// at least the bound of the question. PROOF.md, "The condition number in the 2-norm", says why.
[[nodiscard]] bool has_ratio(const Question& question, const std::vector<Ball>& A, long bits);

}  // namespace regulus::verifier
