// SPDX-License-Identifier: GPL-3.0-or-later
// Branch and prune over one branch of a closure: boxes with tubes, and the links between them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "codegen/question/closure/tube_judge.hpp"
#include "runtime/problem/observer.hpp"
#include "runtime/search/box_search.hpp"

namespace regulus::detail {

struct BranchSettings : BoxSearchSettings {
  /// Boxes are not split in a variable narrower than this part of its range.
  double min_relative_width = 0x1p-32;
  /// Decide every box, also after one that cannot be, and keep the uncertain quantities whole.
  bool paves = false;
  /// Asked at most four times: once about all of the motion, where `place` is empty, and about the
  /// middle of a small box without a tube, by variable; `is_lost`: no branch was followed to it. True:
  /// the search ends.
  std::function<bool(const std::vector<double>& place, bool is_lost)> ask{};
};

/// A box that is not split.
struct BranchLeaf {
  TreeBox at;
  std::optional<BranchTube> tube{};  ///< none: it is outside, or undecided
  bool is_outside = false;           ///< it may have a tube, as a part of the branch
};

/// The boxes of a search, with the splits that made them.
class BranchTree {
 public:
  static constexpr std::size_t kNone = std::size_t(-1);

  struct Node {
    std::size_t variable = kNone;  ///< of the split; kNone: it is no split
    double at = 0;
    BoxId lower = 0;
    std::size_t leaf = kNone;  ///< index into leaves()
  };

  void split(BoxId box, std::size_t variable, double at, BoxId lower);
  void leave(BranchLeaf leaf);
  /// Gives a leaf another tube over its box.
  void replace(std::size_t leaf, BranchTube tube) { leaves_.at(leaf).tube = std::move(tube); }
  void remove_tube(std::size_t leaf) { leaves_.at(leaf).tube.reset(); }

  [[nodiscard]] const Node& node(BoxId box) const { return nodes_.at(box); }
  [[nodiscard]] const std::vector<BranchLeaf>& leaves() const { return leaves_; }
  /// Returns the splits in the order of the numbers that they make.
  [[nodiscard]] std::vector<Split> splits() const;

  /// Calls `visit` for each two leaves with tubes whose boxes share a face, and the face.
  void for_neighbours(const std::vector<Interval>& root,
                      const std::function<void(std::size_t a, std::size_t b,
                                               const std::vector<Interval>& face)>& visit) const;
  /// The same for the leaves of two trees, of which `a` is of this one: they meet where its first
  /// variable is largest and that of the other tree is least. Of that variable the face has no meaning.
  /// `root`: the common box of both.
  void for_neighbours_after(
      const BranchTree& next, const std::vector<Interval>& root,
      const std::function<void(std::size_t a, std::size_t b, const std::vector<Interval>& face)>&
          visit) const;
  /// Returns the leaves in which a place may lie. Shape: an interval for each variable.
  [[nodiscard]] std::vector<std::size_t> leaves_at(std::span<const Interval> place) const;
  /// Returns the leaf that a box is a part of; nullopt if it is a part of none.
  [[nodiscard]] std::optional<std::size_t> leaf_with(std::span<const Interval> box) const;

 private:
  std::vector<Node> nodes_ = std::vector<Node>(1);
  std::vector<BranchLeaf> leaves_;
};

/// Keeps the splits, also those of an earlier run.
class SplitRecorder final : public Observer {
 public:
  explicit SplitRecorder(BranchTree& tree) : tree_(tree) {}
  void on_split(const OpenBox&, const Split& split) noexcept override {
    tree_.split(split.parent, split.variable, split.at, split.lower);
  }

 private:
  BranchTree& tree_;
};

struct BranchResult {
  BranchTree tree;
  bool is_complete = false;                    ///< every box has a tube or is outside
  bool is_empty = false;                       ///< every box is outside
  bool is_refuted = false;                     ///< by BranchSettings::ask
  Reason reason = Reason::kAllBoxesCertified;  ///< why it is not complete
  std::vector<Interval> blocking_box{};        ///< the first box that could not be decided
  std::optional<Reason> stopped_by{};
  std::uint64_t boxes = 0, largest_open = 0;
  double seconds = 0;
};

/// Finds a tube for every box of the variety. It halves ranges of motion parameters, and those of
/// uncertain quantities where that does not help. The result does not depend on threads or workers.
/// `progress` may be null: a box with a tube is a leaf of Rule::kSecondOrder.
///
/// Throws    the exceptions of the workers.
[[nodiscard]] BranchResult search_branch(const ClosureQuestion& question,
                                         const BranchSettings& settings, Observer* progress);

}  // namespace regulus::detail
