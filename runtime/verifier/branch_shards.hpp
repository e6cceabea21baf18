// SPDX-License-Identifier: Apache-2.0
// The tubes of a branch whose proof is in shards: are they of one branch? PROOF.md, "Shards".
#pragma once

#include <vector>

#include "runtime/verifier/shard_file.hpp"
#include "runtime/verifier/shards.hpp"
#include "runtime/verifier/work_clock.hpp"

namespace regulus::verifier {

/// Shards whose leaves are proved, each alone.
struct ProvedShards {
  Lines& index;  ///< for the lines of messages
  const ShardedTrees& trees;
  const std::vector<ListedShard>& listed;
  const std::vector<ShardProof>& proofs;  ///< of each, by whichever process
};

/// Reads all shards again, one after the other, as one proof, and links the tubes of their leaves.
///
/// Requires  each shard is proved, and begins where the one before it ends; the trees are of a closure.
/// Ensures   returns only if these are the lines whose leaves were proved, and if the tubes of all are of
///           one branch, as BranchTree::check() says; throws Rejection or Unfinished otherwise.
void link_shards(const ProvedShards& shards, const Options& options, WorkClock& clock,
                 Verification& result);

}  // namespace regulus::verifier
