// SPDX-License-Identifier: Apache-2.0
// The proof that a branch of a closure reaches a singular configuration: FORMAT.md, "Closures".
#pragma once

#include "runtime/verifier/variety.hpp"
#include "runtime/verifier/verify.hpp"

namespace regulus::verifier {

/// Reads the lines after `proof` up to the end of the file. Returns if the claim SINGULARITY is
/// proved; throws Rejection or Unfinished.
///
/// Requires  question.closure.
void check_fold(Lines& lines, Question& question, const Variety& variety, const Options& options,
                Verification& result);

}  // namespace regulus::verifier
