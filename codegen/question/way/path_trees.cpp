// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/path_trees.hpp"

#include <algorithm>
#include <new>

#include "codegen/question/way/path_variety.hpp"

namespace regulus::detail {

BoxId PathTrees::on_piece(BoxId box) const {
  const auto found = number_.find(box);
  return found == number_.end() ? 0 : found->second;
}

void PathTrees::on_split(const OpenBox& box, const Split& split) noexcept {
  const Interval& u = box.box[0];
  if (PathVariety::is_group(u)) return;
  const auto piece = std::size_t(u.lo);
  if (piece >= trees_.size()) return;
  BoxId& next = next_[piece];
  const double at = split.variable == 0 ? split.at - double(piece) : split.at;
  trees_[piece].split({on_piece(box.id), split.variable, at, next});
  try {
    number_.emplace(split.lower, next);
    number_.emplace(split.lower + 1, next + 1);
  } catch (const std::bad_alloc&) {
    trees_[piece].lose();
  }
  next += 2;
}

void PathTrees::on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept {
  const auto first = std::size_t(box.box[0].lo);
  const std::size_t count =
      PathVariety::is_group(box.box[0]) ? std::size_t(box.box[0].hi) - first : 1;
  const std::size_t end = std::min(first + count, trees_.size());
  for (std::size_t piece = first; piece < end; ++piece) trees_[piece].leaf(on_piece(box.id), rule);
}

}  // namespace regulus::detail
