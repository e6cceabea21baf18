// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/closure_way_paving.hpp"

#include <algorithm>
#include <utility>

namespace regulus {
namespace {

/// Adds the leaves of one piece. Its first variable is s, and a paving halves no other.
void add_parts(const ClosureResult& piece, std::size_t k, std::vector<PathStretch>& parts) {
  const std::vector<BranchLeaf>& leaves = piece.branch.tree.leaves();
  const std::vector<char>& on_branch = piece.links.on_branch;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const bool is_free = i < on_branch.size() && on_branch[i] != 0;
    PathStretch part{is_free                ? Claim::kFree
                     : leaves[i].is_outside ? Claim::kOutside
                                            : Claim::kUndecided,
                     {},
                     {k, leaves[i].at.box[0].lo},
                     {k, leaves[i].at.box[0].hi}};
    if (part.claim == Claim::kUndecided && !leaves[i].tube) part.reason = piece.branch.reason;
    parts.push_back(part);
  }
}

}  // namespace

std::vector<PathStretch> stretches_in_order(std::vector<PathStretch> parts, std::size_t pieces,
                                            Reason not_reached) {
  std::ranges::sort(
      parts, {}, [](const PathStretch& part) { return std::pair(part.begin.piece, part.begin.s); });
  std::vector<PathStretch> stretches;
  auto part = parts.begin();
  for (std::size_t k = 0; k < pieces; ++k) {
    if (part == parts.end() || part->begin.piece != k)
      append_stretch(stretches, {Claim::kUndecided, not_reached, {k, 0}, {k, 1}});
    for (; part != parts.end() && part->begin.piece == k; ++part) append_stretch(stretches, *part);
  }
  return stretches;
}

std::vector<PathStretch> stretches_of(const PreparedWay& prepared, const WayFinding& found) {
  std::vector<PathStretch> parts;
  for (std::size_t k = 0; k < found.pieces.size(); ++k) add_parts(found.pieces[k], k, parts);
  return stretches_in_order(std::move(parts), prepared.pieces(),
                            found.result.stopped_by.value_or(Reason::kAllBoxesCertified));
}

}  // namespace regulus
