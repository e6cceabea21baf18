// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the proof of an end of a bracket over a branch: FORMAT.md, "Bounds over a branch".
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/question/closure/closure_run.hpp"
#include "codegen/question/closure/paving_certificate.hpp"
#include "codegen/question/quantity/quantity.hpp"

namespace regulus::detail {

/// A branch that is proved in pieces: over ranges in one, along way-points in all.
struct ProvedPieces {
  const Request& request;
  const ReportLabels& labels;  ///< of the kernel
  std::vector<const BranchTree*> trees;
};

/// The place of an attained end, which has no coordinates if nothing moves.
struct PlaceOfValue {
  std::size_t piece = 0;
  std::span<const Interval> at;
};

/// Writes the file of the safe end, or of the attained one, which has a place; notes why there is none.
///
/// Requires  each box of the trees has a tube or is outside, and the tubes are those of the branch.
void certify_value(EndProofs& proofs, const ProvedPieces& branch, const Component& component,
                   const GiNaC::ex& bound, const std::optional<PlaceOfValue>& place);

/// Writes the proof that every force is within its limits over the tubes of the trees, or, at a place,
/// that some force is not. An empty `path` means no certificate. Requires the same.
[[nodiscard]] ProofStatus certify_forces(const std::string& path, const ProvedPieces& branch,
                                         const VectorSet& load,
                                         const std::optional<PlaceOfValue>& place,
                                         const ProofPlacing& placing);

/// Writes the proof that |det Φ_p| exceeds the threshold of the motion over the tubes of the trees, or, at
/// a place, that it does not. An empty `path` means no certificate. Requires the same.
[[nodiscard]] ProofStatus certify_exceeded(const std::string& path, const ProvedPieces& branch,
                                           const std::optional<PlaceOfValue>& place,
                                           const ProofPlacing& placing);

/// Writes the proof of a paving of the forces; `trees`: of all pieces. An empty `path` means no certificate.
[[nodiscard]] ProofStatus certify_paved_forces(const std::string& path, const ProvedPieces& branch,
                                               const VectorSet& load,
                                               const std::vector<PavedTree>& trees,
                                               const ProofPlacing& placing);

}  // namespace regulus::detail
