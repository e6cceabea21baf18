// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/closure_way_paving.hpp"

#include <algorithm>
#include <utility>

#include "codegen/question/closure/paving_certificate.hpp"

namespace regulus::detail {
namespace {

/// Adds the leaves of one piece. Its first variable is s, and a paving halves no other.
void add_parts(const PavedTree& piece, Reason reason, std::size_t k,
               std::vector<PathStretch>& parts) {
  for (std::size_t i = 0; i < piece.words.size(); ++i) {
    const BranchLeaf& leaf = piece.tree->leaves()[i];
    PathStretch part{piece.claim_of(i), {}, {k, leaf.at.box[0].lo}, {k, leaf.at.box[0].hi}};
    if (part.claim == Claim::kUndecided && !leaf.tube) part.reason = reason;
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
  const std::vector<PavedTree> paved = paved_trees(found.pieces, found.threshold);
  for (std::size_t k = 0; k < paved.size(); ++k)
    add_parts(paved[k], found.pieces[k].branch.reason, k, parts);
  return stretches_in_order(std::move(parts), prepared.pieces(),
                            found.result.stopped_by.value_or(Reason::kAllBoxesCertified));
}

}  // namespace regulus::detail
