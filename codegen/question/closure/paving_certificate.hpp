// SPDX-License-Identifier: GPL-3.0-or-later
// The certificate PAVING of a branch: on which boxes is it certain (FORMAT.md, "Pavings of a branch")?
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/question/closure/closure_way.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::detail {

/// A tree with what is claimed of its leaves.
struct PavedTree {
  const BranchTree* tree = nullptr;  ///< null: that of a segment which was not reached
  std::vector<const char*> words{};  ///< by leaf, of FORMAT.md

  bool has_threshold = false;  ///< it is compared on the leaves

  /// Returns the claims about the branch alone.
  [[nodiscard]] static PavedTree of(const ClosureResult& piece);
  /// Returns the claim about a leaf: free if the branch is there and exceeds a threshold, if there is one.
  [[nodiscard]] Claim claim_of(std::size_t leaf) const;
};

/// Returns the claims about the pieces that were reached, also of a threshold. They refer to both.
[[nodiscard]] std::vector<PavedTree> paved_trees(std::span<const ClosureResult> pieces,
                                                 const std::optional<ThresholdFinding>& threshold);

/// Writes the certificate of the trees of all pieces. `about`: its claim is CertifiedQuestion::paving. An
/// empty `path` means no certificate.
[[nodiscard]] ProofStatus certify_paved(const std::string& path, const Request& request,
                                        const ReportLabels& labels,
                                        const std::vector<PavedTree>& trees,
                                        const CertifiedAbout& about, const ProofPlacing& placing);

/// Writes the proof of a branch, if it is proved, or of those boxes where it is certain; or of a threshold.
[[nodiscard]] ProofStatus certify_paving(const std::string& path, const PreparedClosure& prepared,
                                         const ClosureFinding& found, const ProofPlacing& placing);
/// The same along way-points.
[[nodiscard]] ProofStatus certify_paving(const std::string& path, const PreparedWay& prepared,
                                         const WayFinding& found, const ProofPlacing& placing);

}  // namespace regulus::detail
