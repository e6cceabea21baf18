// SPDX-License-Identifier: Apache-2.0
// A claim about all solutions of the equations of a closure, by a search. PROOF.md, "All solutions of
// equations".
#pragma once

#include "runtime/verifier/verify.hpp"
#include "runtime/verifier/work_clock.hpp"

namespace regulus::verifier {

/// Returns if the claim is proved; throws Rejection or Unfinished.
///
/// Requires  question.solutions and question.closure.
void search_solutions(Lines& lines, Question& question, const Options& options,
                      Verification& result);

}  // namespace regulus::verifier
