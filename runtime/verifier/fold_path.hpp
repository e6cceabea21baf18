// SPDX-License-Identifier: Apache-2.0
// The proof that a branch of a closure reaches a singular configuration: FORMAT.md, "Closures".
#pragma once

#include "runtime/verifier/branch_tree.hpp"
#include "runtime/verifier/variety.hpp"
#include "runtime/verifier/verify.hpp"

namespace regulus::verifier {

/// Reads the lines after the current one up to the end of the file. Returns if the claim SINGULARITY
/// is proved; throws Rejection or Unfinished.
///
/// Requires  question.closure.
void check_fold(Lines& lines, Question& question, const Variety& variety, const Options& options,
                Verification& result);

/// The same for a piece of a motion, from the current line on. `before`: the piece before, whose branch
/// is checked, and which ends where this one begins; null for the first piece.
void check_fold_of_piece(Lines& lines, Question& question, const Variety& variety,
                         const Options& options, const BranchBoxes* before, Verification& result);

}  // namespace regulus::verifier
