// SPDX-License-Identifier: GPL-3.0-or-later
// The option --certificate for a motion along a trajectory.
#pragma once

#include <memory>
#include <string>

#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/question/way/trajectory_run.hpp"

namespace regulus::detail {

/// Writes the trees of all pieces, in their order. Throws FileError; std::bad_alloc if there was no
/// memory for one of them.
[[nodiscard]] std::shared_ptr<ProofFile> proof_of_pieces(const std::string& path,
                                                         const std::string& head,
                                                         const std::vector<TreeKept>& trees,
                                                         LeafWord word);
/// The same, and puts it in its place.
void write_pieces(const std::string& path, const std::string& head,
                  const std::vector<TreeKept>& trees, LeafWord word, const ProofPlacing& placing);

/// Writes the proof of the verdict: of all pieces, or the singular pose on one of them. An empty
/// `path` means no certificate. `motion`: what it is about, if this is not the check's own question.
/// The status says if a file could not be written.
[[nodiscard]] ProofStatus certify_trajectory(const std::string& path, const TrajectoryCheck& check,
                                             const ProofPlacing& placing);
[[nodiscard]] ProofStatus certify_trajectory(const std::string& path, const TrajectoryCheck& check,
                                             const CertifiedMotion& motion,
                                             const ProofPlacing& placing);

}  // namespace regulus::detail
