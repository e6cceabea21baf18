// SPDX-License-Identifier: Apache-2.0
// Judges again what a saved tree says about its boxes.
#pragma once

#include <functional>
#include <unordered_map>

#include "runtime/search/box_judges.hpp"
#include "runtime/search/saved_tree.hpp"

namespace regulus::detail {

/// So many boxes that the threads and workers are busy most of the time.
inline constexpr std::size_t kJudgedAtOnce = 2048;

/// Judges leaves of a tree again. If findings have a bound, a box above a leaf may have a smaller
/// one, which holds for the leaf, too: while the bound of the text is smaller than what was found,
/// the next box above is judged as well. So each bound is that of the text if the text is true, and
/// is proved in any case. Judge::inherit() says what else of a box above holds for a leaf.
template <class Judge>
class TreeProof {
 public:
  using Finding = typename Judge::Finding;
  using Revise = std::function<void(const std::vector<Interval>& box, Finding&)>;

  /// All must outlive this object. `revise`: takes from each finding what is of no use; may be empty.
  TreeProof(const RestoredTree& tree, BoxJudges<Judge>& judges, std::function<bool()> must_stop,
            Revise revise = {})
      : tree_(tree),
        judges_(judges),
        must_stop_(std::move(must_stop)),
        revise_(std::move(revise)) {}

  /// Judges the first `count` leaves, and the boxes that showed more.
  ///
  /// Ensures   false if must_stop() returned true, or if memory ran out.
  /// Throws    SavedTreeError as RestoredTree::box() does.
  [[nodiscard]] bool prove(std::size_t count, const std::vector<BoxId>& shown) {
    leaves_.resize(count), shown_.resize(shown.size());
    std::vector<BoxId> boxes;
    for (std::size_t i = 0; i < count; ++i) boxes.push_back(tree_.leaves()[i].box);
    const auto keep_leaf = [this](std::size_t i, Finding& found) { leaves_[i] = std::move(found); };
    const auto keep_shown = [this](std::size_t i, Finding& found) { shown_[i] = std::move(found); };
    return judge(boxes, kFar, keep_leaf) && use_boxes_above() && judge(shown, 0, keep_shown);
  }

  /// In the order of RestoredTree::leaves().
  [[nodiscard]] std::vector<Finding>& leaves() { return leaves_; }
  [[nodiscard]] std::vector<Finding>& shown() { return shown_; }

 private:
  /// With this horizon nothing is shown beside the bounds; with 0 all is.
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  static constexpr bool kHasBounds = requires(Finding & finding) { Judge::bound(finding); };

  /// A leaf, and the last box above it whose bound was used.
  struct Climber {
    std::size_t leaf;
    BoxId box;
  };

  /// The boxes above the leaves, one generation after the other.
  bool use_boxes_above() {
    if constexpr (kHasBounds) {
      std::vector<Climber> climbers;
      for (std::size_t i = 0; i < leaves_.size(); ++i)
        climbers.push_back({i, tree_.leaves()[i].box});
      while (true) {
        std::erase_if(climbers, [this](const Climber& c) { return is_reached(c); });
        if (climbers.empty()) break;
        for (Climber& c : climbers) c.box = tree_.parent(c.box);
        if (!judge_above(climbers)) return false;
        for (const Climber& c : climbers) inherit(leaves_[c.leaf], above_.at(c.box));
      }
    }
    return true;
  }

  [[nodiscard]] bool is_reached(const Climber& c) {
    return c.box == 0 || Judge::bound(leaves_[c.leaf]) <= tree_.leaves()[c.leaf].bound;
  }

  static void inherit(Finding& own, Finding& above) {
    if constexpr (requires { Judge::inherit(own, above); }) Judge::inherit(own, above);
    Judge::bound(own) = std::min(Judge::bound(own), Judge::bound(above));
  }

  bool judge_above(const std::vector<Climber>& climbers) {
    std::vector<BoxId> boxes;
    for (const Climber& c : climbers)
      if (above_.try_emplace(c.box).second) boxes.push_back(c.box);
    return judge(boxes, kFar,
                 [&](std::size_t i, Finding& found) { above_.at(boxes[i]) = std::move(found); });
  }

  /// Calls keep(i, finding) for each box.
  template <class Keep>
  bool judge(const std::vector<BoxId>& ids, double horizon, Keep keep) {
    for (std::size_t from = 0; from < ids.size(); from += kJudgedAtOnce) {
      if (must_stop_()) return false;
      const std::size_t count = std::min(kJudgedAtOnce, ids.size() - from);
      std::vector<std::vector<Interval>> boxes;
      for (std::size_t i = 0; i < count; ++i) boxes.push_back(tree_.box(ids[from + i]));
      std::vector<Finding> findings(count);
      if (!judges_.judge(boxes, findings, horizon)) return false;
      for (std::size_t i = 0; i < count; ++i) {
        if (revise_) revise_(boxes[i], findings[i]);
        keep(from + i, findings[i]);
      }
    }
    return true;
  }

  const RestoredTree& tree_;
  BoxJudges<Judge>& judges_;
  const std::function<bool()> must_stop_;
  const Revise revise_;
  std::vector<Finding> leaves_, shown_;
  std::unordered_map<BoxId, Finding> above_;  ///< about boxes that were split
};

}  // namespace regulus::detail
