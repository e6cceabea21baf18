// SPDX-License-Identifier: GPL-3.0-or-later
// Proves again what a saved tree of a search for roots says.
//
// That search narrows a box before it halves what is left, so each narrowing is a claim, and not only
// each leaf. Of the text nothing but the cuts is a fact.
//
// Above open boxes, and above leaves that claim more than to be empty, each box is judged from the root
// on, as the search has judged it: so these boxes are those of a search without a stop. Every other leaf
// claims to be empty. It is judged as the cuts alone leave it, of the nearest box above that was judged:
// these boxes tile that one, whatever the numbers of the text are. Most are empty as they are, although
// they are larger than those of the search, so that boxes above them need not be judged. A leaf that
// is not shown to be empty so is judged as the search has done.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "codegen/question/solve/root_judge.hpp"
#include "runtime/search/saved_tree.hpp"

namespace regulus::detail {

class RetracedRoots {
 public:
  using Box = std::vector<Interval>;
  /// Returns false if judging ended early.
  using JudgeMany = std::function<bool(std::span<const Box>, std::span<RootFinding>)>;
  /// Narrows a box. Returns the variable in which what is left is halved; nullopt: it is a leaf.
  using Narrow = std::function<std::optional<std::size_t>(Box&, const RootFinding&)>;

  struct Leaf {
    Box box;  ///< narrowed, unless it is open
    RootFinding finding{};
  };

  /// `tree`: Splits::kByCuts; it must outlive this object.
  RetracedRoots(const RestoredTree& tree, Narrow narrow);

  /// Returns false if judging ended early.
  ///
  /// Ensures   all solutions of `root` are in the boxes of leaf().
  /// Throws    SavedTreeError if the search has another tree.
  [[nodiscard]] bool prove(const Box& root, const JudgeMany& judge);

  /// Returns a leaf or an open box; null: the leaf is empty.
  [[nodiscard]] Leaf* leaf(BoxId box);

 private:
  struct Part {
    BoxId id;
    Box box;
  };

  void require_judging(BoxId leaf);
  [[nodiscard]] bool judge_from_root(const Box& root, const JudgeMany& judge);
  [[nodiscard]] bool judge_generation(const std::vector<Part>& parts, const JudgeMany& judge);
  void follow(Part part, std::vector<Part>& next);
  void halve(Part part, std::vector<Part>& halves) const;
  [[nodiscard]] bool judge_empty(const JudgeMany& judge, bool& are_all);
  [[nodiscard]] std::vector<Part> empty_leaves();

  const RestoredTree& tree_;
  const Narrow narrow_;
  std::vector<const RestoredTree::Step*> split_;  ///< by box; null: it is not split
  std::vector<BoxId> lower_;                      ///< by box: its lower part
  std::vector<bool> is_open_, is_judged_, is_empty_;
  std::unordered_map<BoxId, RootFinding> found_;  ///< of boxes that are judged as the search did
  std::vector<Part> rest_;                        ///< whose leaves claim to be empty
  std::unordered_map<BoxId, Leaf> leaves_;
};

}  // namespace regulus::detail
