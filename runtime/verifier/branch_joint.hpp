// SPDX-License-Identifier: Apache-2.0
// Shows that a piece of a closure's motion begins where the one before it ends: PROOF.md, "Pieces of a closure".
#pragma once

#include "runtime/verifier/pieces.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Throws Unfinished unless the first parameter goes from 0 to 1, and the equations use it and the
/// names of the pieces in the poses alone.
void require_piece_of_closure(const Pieces& pieces, Question& question);

/// Shows that each commanded pose has the same value at the end of piece k − 1 and at the begin of
/// piece k, for all values of the other parameters. Throws Rejection or Unfinished.
///
/// Requires  `question` is that of piece k; k > 0; require_piece_of_closure() has returned.
void require_joint(const Pieces& pieces, std::size_t k, Question& question);

}  // namespace regulus::verifier
