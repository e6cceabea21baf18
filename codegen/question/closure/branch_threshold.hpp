// SPDX-License-Identifier: GPL-3.0-or-later
// Compares |det Φ_p| with the threshold of a motion over a branch that was followed or paved: it is the
// limit of a determinant (branch_value.hpp), and must be exceeded.
#pragma once

#include <string>

#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/question/closure/piece_values.hpp"
#include "codegen/question/closure/threshold_finding.hpp"

namespace regulus::detail {

[[nodiscard]] inline bool has_threshold(const Request& request) {
  return !request.motion.alpha.is_zero();
}

/// Returns the value that the threshold is compared with.
///
/// Requires  the model has a closure.
[[nodiscard]] BranchValue value_at_threshold(const Model& model);

/// Returns what other processes are told of the search of the branch, before that of a threshold.
[[nodiscard]] SearchTopic topic_of_branch(SearchTopic topic, const Request& request);

/// Compares all over the branch. `run`: of the branch, beside whose searches the file has these.
///
/// Requires  has_threshold(pieces.request()), and the branch is proved.
[[nodiscard]] ThresholdFinding compare_threshold(const PiecesOfBranch& pieces,
                                                 const BoxSearchSettings& settings,
                                                 const PiecesRun& run);

/// Compares on every box of the pieces that were paved, down to `resolution`. `run`: the same.
///
/// Requires  has_threshold(pieces.request()).
[[nodiscard]] ThresholdFinding pave_threshold(const PiecesOfBranch& pieces, double resolution,
                                              const BoxSearchSettings& settings,
                                              const PiecesRun& run);

/// Puts what was found of the threshold into the result of a branch.
void conclude(Result& result, const ThresholdFinding& found);

/// Writes the proof of what was found: of a check, or of a paving. An empty `path` means no certificate.
[[nodiscard]] ProofStatus certify_threshold(const std::string& path, const PiecesOfBranch& pieces,
                                            const ThresholdFinding& found,
                                            const ProofPlacing& placing);

}  // namespace regulus::detail
