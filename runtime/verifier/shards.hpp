// SPDX-License-Identifier: Apache-2.0
// Proofs in shards: an index, and one file for each part of the tree.
#pragma once

#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {

/// Reads on from the line `proof` of an index to its end, and proves all leaves of the shards.
/// `head`: the lines before. Returns if the claim NO SINGULARITY is proved; throws Rejection or
/// Unfinished.
void check_shards(Lines& lines, const std::vector<std::string>& head, Question& question,
                  const Variety& variety, const Options& options, Verification& result);

}  // namespace regulus::verifier
