// SPDX-License-Identifier: Apache-2.0
// Proofs in shards: an index, and one file for each part of the tree, or of the trees of all pieces.
#pragma once

#include <functional>

#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {

/// What the leaves of one tree are about.
struct TreeQuestion {
  Question& question;
  const Variety& variety;
};

/// The trees whose lines are in the shards, one after the other.
struct ShardedTrees {
  std::string sha256;         ///< of the lines of the index from its second line to `proof`
  bool is_piecewise = false;  ///< a tree for each piece, with a line `tree` between two
  std::size_t count = 1;
  /// Returns what the tree of this number, from 0, is about. It is valid until the next call.
  std::function<TreeQuestion(std::size_t)> about;
};

/// Reads on from the line `proof` of an index to its end, and proves all leaves of the shards.
/// Returns if the claim is proved; throws Rejection or Unfinished.
void check_shards(Lines& lines, const ShardedTrees& trees, const Options& options,
                  Verification& result);

}  // namespace regulus::verifier
