// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the proof of an end of a bracket over a branch: FORMAT.md, "Bounds over a branch".
#pragma once

#include <span>

#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/question/closure/closure_run.hpp"
#include "codegen/question/quantity/quantity.hpp"

namespace regulus {

/// Writes the file of the safe end, or of the attained one, which has a place; notes why there is none.
///
/// Requires  each box of the tree has a tube or is outside, and the tubes are those of the branch.
void certify_value(EndProofs& proofs, const PreparedClosure& prepared, const Component& component,
                   const GiNaC::ex& bound, const BranchTree& tree, std::span<const Interval> place);

}  // namespace regulus
