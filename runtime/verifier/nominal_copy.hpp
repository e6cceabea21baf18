// SPDX-License-Identifier: Apache-2.0
// The mechanism without errors beside the one with them: PROOF.md, "Finite errors over a branch".
#pragma once

#include <map>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Returns the middle of each uncertain quantity, and 0 for each error, by variable.
[[nodiscard]] std::map<NodeId, NodeId> values_without_errors(Question& question);

/// Adds a copy of each unknown and of each equation, and of all that must be defined. In the copies
/// uncertain quantities have the middles of their ranges, and errors are 0; they have no other
/// variables than parameters of the motion. The copies come after the originals, in their order.
///
/// Requires  question.closure; all lines up to `proof` have been read.
/// Throws    Unfinished if there are too many variables then.
void add_nominal_copy(Question& question);

}  // namespace regulus::verifier
