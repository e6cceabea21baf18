// SPDX-License-Identifier: Apache-2.0
// The certificate of a finite error over the branch of a closure: Distances.v has its proof. The question
// in Coq has the mechanism once; its copy without errors is made by Distances.v.
#pragma once

#include <string>
#include <vector>

#include "runtime/formal/coq_branch.hpp"

namespace regulus::verifier {

/// Takes the quantity out of the lines of a certificate, which are those of `question`. Throws
/// Unfinished if there is no theorem about it.
///
/// Requires  is_finite_error(question).
[[nodiscard]] BranchQuantityText split_distance(const Question& question,
                                                const std::vector<std::string>& lines);

}  // namespace regulus::verifier
