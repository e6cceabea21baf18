// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the proof of an end of a bracket over a branch: FORMAT.md, "Bounds over a branch".
#pragma once

#include <optional>
#include <span>

#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/question/closure/closure_run.hpp"
#include "codegen/question/quantity/quantity.hpp"

namespace regulus {

/// The place of an attained end, which has no coordinates if nothing moves; nullopt: of the safe end.
using PlaceOfValue = std::optional<std::span<const Interval>>;

/// Writes the file of the safe end, or of the attained one, which has a place; notes why there is none.
///
/// Requires  each box of the tree has a tube or is outside, and the tubes are those of the branch.
void certify_value(EndProofs& proofs, const PreparedClosure& prepared, const Component& component,
                   const GiNaC::ex& bound, const BranchTree& tree, PlaceOfValue place);

/// Writes the proof that every force is within its limits over the tubes of a tree, or, at a place, that
/// some force is not. An empty `path` means no certificate. Requires the same.
[[nodiscard]] ProofStatus certify_forces(const std::string& path, const PreparedClosure& prepared,
                                         const VectorSet& load, const BranchTree& tree,
                                         PlaceOfValue place, const ProofPlacing& placing);

}  // namespace regulus
