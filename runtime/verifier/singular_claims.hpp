// SPDX-License-Identifier: Apache-2.0
// Claims about the extreme singular values of a matrix A, at a point and over a set. PROOF.md, "The
// condition number in the 2-norm", derives the tests.
#pragma once

#include <vector>

#include "runtime/verifier/ball.hpp"
#include "runtime/verifier/extreme_discs.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Returns the number that B = UᵀAV must keep so that A keeps N; 0 if there is none.
[[nodiscard]] double bound_of_rotated(SingularClaim claim, const SingularBases& bases,
                                      std::size_t rows, std::size_t columns, Interval N);

/// Returns true only if A keeps N at every point of the set. After false, `parts` has roughly what each
/// variable of B adds to the bounds by errors of second order; empty if nothing is known.
[[nodiscard]] bool keeps_singular_claim(SingularClaim claim, const RotatedMatrix& B,
                                        const SingularBases& bases, std::size_t rows,
                                        std::size_t columns, Interval N,
                                        std::vector<double>& parts);

/// Returns true only if every matrix in A, given row by row, is singular, or breaks the claim: its
/// condition number or its largest singular value is at least N, or its least one at most N.
[[nodiscard]] bool breaks_singular_claim(SingularClaim claim, const std::vector<Ball>& A,
                                         std::size_t rows, std::size_t columns, const Ball& N,
                                         long bits);

/// The same of the matrix of a question about the condition number, and of its bound.
[[nodiscard]] bool has_ratio(const Question& question, const std::vector<Ball>& A, long bits);

}  // namespace regulus::verifier
