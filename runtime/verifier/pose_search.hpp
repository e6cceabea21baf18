// SPDX-License-Identifier: Apache-2.0
// A claim about all poses of a platform on six legs, by a search. PROOF.md, "All poses, by a search".
#pragma once

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/verify.hpp"
#include "runtime/verifier/work_clock.hpp"

namespace regulus::verifier {

/// Returns if the claim is proved; throws Rejection or Unfinished. The proof has been read.
///
/// Requires  question.solutions has six legs, and there is no closure. `places` has all values of the
///           variables.
void search_poses(Lines& lines, const Question& question, const Box& places, const Options& options,
                  Verification& result);

}  // namespace regulus::verifier
