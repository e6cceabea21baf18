// SPDX-License-Identifier: GPL-3.0-or-later
// The trees of single pieces, from the tree of a search over a PathVariety.
#pragma once

#include <unordered_map>
#include <vector>

#include "runtime/proof/tree_kept.hpp"

namespace regulus::detail {

/// A leaf that is a group of pieces is one of each. A tree that does not fit into memory cannot be
/// written (TreeKept::write_to).
class PathTrees final : public Observer {
 public:
  explicit PathTrees(std::size_t pieces) : trees_(pieces), next_(pieces, 1) {}

  void on_split(const OpenBox& box, const Split& split) noexcept override;
  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override;

  [[nodiscard]] const std::vector<TreeKept>& trees() const noexcept { return trees_; }

 private:
  [[nodiscard]] BoxId on_piece(BoxId box) const;

  std::vector<TreeKept> trees_;
  std::vector<BoxId> next_;                    ///< of each piece, the next number of a box
  std::unordered_map<BoxId, BoxId> number_{};  ///< of a box of the search on its piece; else 0
};

}  // namespace regulus::detail
