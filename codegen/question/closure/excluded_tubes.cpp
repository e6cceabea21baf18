// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/excluded_tubes.hpp"

#include <utility>

namespace regulus::detail {
namespace {

/// Returns how many leaves of the motion neighbours join with one of them, and how many there are.
std::pair<std::size_t, std::size_t> joined_leaves(const BranchTree& tree,
                                                  const std::vector<Interval>& root) {
  const std::vector<BranchLeaf>& leaves = tree.leaves();
  const auto counts = [&](std::size_t leaf) {
    return leaves[leaf].tube && !leaves[leaf].is_outside;
  };
  std::vector<std::vector<std::size_t>> beside(leaves.size());
  tree.for_neighbours(root, [&](std::size_t a, std::size_t b, const std::vector<Interval>&) {
    if (counts(a) && counts(b)) beside[a].push_back(b), beside[b].push_back(a);
  });
  std::vector<std::size_t> waiting;
  std::vector<char> is_seen(leaves.size(), 0);
  std::size_t all = 0, joined = 0;
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf)
    if (counts(leaf) && ++all == 1) waiting.push_back(leaf), is_seen[leaf] = 1;
  while (!waiting.empty()) {
    const std::size_t leaf = waiting.back();
    waiting.pop_back();
    ++joined;
    for (const std::size_t other : beside[leaf])
      if (is_seen[other] == 0) waiting.push_back(other), is_seen[other] = 1;
  }
  return {joined, all};
}

}  // namespace

void drop_excluded_tubes(BranchTree& tree, const std::vector<Interval>& root) {
  std::vector<std::size_t> excluded;
  for (std::size_t leaf = 0; leaf < tree.leaves().size(); ++leaf)
    if (tree.leaves()[leaf].is_outside && tree.leaves()[leaf].tube) excluded.push_back(leaf);
  if (excluded.empty()) return;
  const auto [joined, all] = joined_leaves(tree, root);
  if (all == 0 || joined < all) return;
  for (const std::size_t leaf : excluded) tree.remove_tube(leaf);
}

}  // namespace regulus::detail
