// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/condition_proofs.hpp"

#include <algorithm>
#include <unordered_map>

namespace regulus {
namespace {

/// So many that the threads and workers are busy most of the time.
constexpr std::size_t kDecidedAtOnce = 2048;

class TreeProof {
 public:
  TreeProof(const ConditionTree& tree, BoxJudges& judges, const std::function<bool()>& must_stop)
      : tree_(tree), judges_(judges), must_stop_(must_stop), proved_(tree.leaves().size()) {}

  /// Returns false if it had to stop.
  bool prove_leaves() {
    std::vector<BoxId> boxes;
    for (const ConditionTree::Leaf& leaf : tree_.leaves()) boxes.push_back(leaf.box);
    return judge(boxes, [this](std::size_t i, BoxFinding& finding) {
      proved_[i] = {finding.is_outside, finding.is_undefined, finding.bound.upper,
                    std::move(finding.bound.impact)};
    });
  }

  /// The boxes above the leaves, one generation after the other.
  bool use_boxes_above() {
    std::vector<Climber> climbers;
    for (std::size_t i = 0; i < proved_.size(); ++i) climbers.push_back({i, tree_.leaves()[i].box});
    while (true) {
      std::erase_if(climbers, [this](const Climber& c) { return is_reached(c); });
      if (climbers.empty()) return true;
      for (Climber& c : climbers) c.box = tree_.parent(c.box);
      if (!judge_above(climbers)) return false;
      for (const Climber& c : climbers)
        proved_[c.leaf].upper = std::min(proved_[c.leaf].upper, above_.at(c.box));
    }
  }

  /// The witness does not depend on what was attained before, since it was better.
  bool show(BoxId box, std::optional<ConditionWitness>& attained) {
    const std::vector<BoxJudges::Box> boxes{tree_.box(box)};
    std::vector<BoxFinding> finding(1);
    if (must_stop_() || !judges_.judge(boxes, finding, 0)) return false;
    attained = std::move(finding.front().attained);
    return true;
  }

  [[nodiscard]] std::vector<ProvedLeaf> take() { return std::move(proved_); }

 private:
  /// A leaf, and the last box above it whose bound was used.
  struct Climber {
    std::size_t leaf;
    BoxId box;
  };

  [[nodiscard]] bool is_reached(const Climber& c) const {
    const ProvedLeaf& proved = proved_[c.leaf];
    return c.box == 0 || proved.is_outside || proved.upper <= tree_.leaves()[c.leaf].upper;
  }

  bool judge_above(const std::vector<Climber>& climbers) {
    std::vector<BoxId> boxes;
    for (const Climber& c : climbers)
      if (above_.emplace(c.box, kInfinity).second) boxes.push_back(c.box);
    return judge(boxes, [&](std::size_t i, const BoxFinding& finding) {
      above_[boxes[i]] = finding.bound.upper;
    });
  }

  /// Calls conclude(i, finding) for each box.
  template <class Conclude>
  bool judge(const std::vector<BoxId>& ids, Conclude conclude) {
    for (std::size_t from = 0; from < ids.size(); from += kDecidedAtOnce) {
      if (must_stop_()) return false;
      const std::size_t count = std::min(kDecidedAtOnce, ids.size() - from);
      std::vector<BoxJudges::Box> boxes;
      for (std::size_t i = 0; i < count; ++i) boxes.push_back(tree_.box(ids[from + i]));
      std::vector<BoxFinding> findings(count);
      if (!judges_.judge(boxes, findings, kInfinity)) return false;
      for (std::size_t i = 0; i < count; ++i) conclude(from + i, findings[i]);
    }
    return true;
  }

  const ConditionTree& tree_;
  BoxJudges& judges_;
  const std::function<bool()>& must_stop_;
  std::vector<ProvedLeaf> proved_;
  std::unordered_map<BoxId, double> above_;  ///< bounds over boxes that were split
};

}  // namespace

std::optional<ProvedTree> prove_again(const ConditionTree& tree, std::optional<BoxId> attained,
                                      BoxJudges& judges, const std::function<bool()>& must_stop) {
  TreeProof proof(tree, judges, must_stop);
  ProvedTree result;
  if (!proof.prove_leaves() || !proof.use_boxes_above()) return std::nullopt;
  if (attained && !proof.show(*attained, result.attained)) return std::nullopt;
  result.leaves = proof.take();
  return result;
}

}  // namespace regulus
