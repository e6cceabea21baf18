// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/closure_way_paving.hpp"

#include <algorithm>

namespace regulus {
namespace {

/// Returns the leaves of one piece in their order. Its first variable is s.
std::vector<PathStretch> parts_of(const ClosureResult& piece, std::size_t k) {
  const std::vector<BranchLeaf>& leaves = piece.branch.tree.leaves();
  const std::vector<char>& on_branch = piece.links.on_branch;
  std::vector<PathStretch> parts;
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
  std::ranges::sort(parts, {}, [](const PathStretch& part) { return part.begin.s; });
  return parts;
}

}  // namespace

std::vector<PathStretch> stretches_of(const PreparedWay& prepared, const WayFinding& found) {
  std::vector<PathStretch> stretches;
  for (std::size_t k = 0; k < prepared.pieces(); ++k) {
    std::vector<PathStretch> parts;
    if (k < found.pieces.size()) parts = parts_of(found.pieces[k], k);
    if (parts.empty())
      parts = {{Claim::kUndecided,
                found.result.stopped_by.value_or(Reason::kAllBoxesCertified),
                {k, 0},
                {k, 1}}};
    for (const PathStretch& part : parts) append_stretch(stretches, part);
  }
  return stretches;
}

}  // namespace regulus
