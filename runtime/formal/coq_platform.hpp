// SPDX-License-Identifier: Apache-2.0
// Lists of the poses of a platform on six legs in space for Coq: Poses.v has their proof.
#pragma once

#include <string>
#include <vector>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Returns the theorem about the list, with its file. It says that the list is complete, if
/// the certificate counts the complex poses; of an INCOMPLETE list, that at least these poses exist.
///
/// Requires: `lines`, those of `question`, a claim about the poses on six legs in space, have been read from
/// `proof`, and no more.
/// Throws Rejection if the proof is no list of roots; Unfinished if no root is certain near a line of
/// it, or if a search has shown that the list is complete.
[[nodiscard]] std::string platform_theorem(Lines& proof, Question& question,
                                           const std::vector<std::string>& lines);

}  // namespace regulus::verifier
