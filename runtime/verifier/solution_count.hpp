// SPDX-License-Identifier: Apache-2.0
// A claim about all solutions, by counting the complex ones. PROOF.md, "All solutions".
#pragma once

#include "runtime/verifier/verify.hpp"

namespace regulus::verifier {

/// Reads the proof, from the line after `proof` to the end of the file. Returns if the claim is proved;
/// throws Rejection or Unfinished.
void check_solutions(Lines& lines, Question& question, const Options& options,
                     Verification& result);

}  // namespace regulus::verifier
