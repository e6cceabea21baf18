// SPDX-License-Identifier: GPL-3.0-or-later
// The certificates of a branch, and of a singular configuration that it reaches.
#pragma once

#include <span>
#include <string>

#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/question/closure/closure_way.hpp"
#include "codegen/question/closure/fold_search.hpp"

namespace regulus::detail {

/// Writes the splits of a tree, and its leaves. `words`: by leaf, of FORMAT.md; a word for a leaf with a tube
/// is followed by the numbers of that.
void write_tree(ProofFile& file, const BranchTree& tree, std::span<const char* const> words);
/// The same for a tree of which every leaf has a tube or is outside.
void write_tree(ProofFile& file, const BranchTree& tree);

/// Writes the proof of a branch, if it is proved. An empty `path` means no certificate.
[[nodiscard]] ProofStatus certify_branch(const std::string& path, const PreparedClosure& prepared,
                                         const ClosureResult& result, const ProofPlacing& placing);

/// Writes the proof of what a check has found, if it has shown anything. An empty `path` means no
/// certificate.
[[nodiscard]] ProofStatus certify_check(const std::string& path, const PreparedClosure& prepared,
                                        const ClosureFinding& found, const ProofPlacing& placing);

/// Writes the proof of a branch along way-points, or of a singular configuration on the first of their
/// segments, if it is shown, or of what was found of a threshold. An empty `path` means no certificate.
[[nodiscard]] ProofStatus certify_way(const std::string& path, const PreparedWay& prepared,
                                      const WayFinding& found, const ProofPlacing& placing);

/// Writes the proof that the branch reaches a singular configuration. An empty `path` means no
/// certificate.
///
/// Requires  fold.is_on_branch.
[[nodiscard]] ProofStatus certify_fold(const std::string& path, const PreparedClosure& prepared,
                                       const Fold& fold, const ProofPlacing& placing);

}  // namespace regulus::detail
