// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/value_paving.hpp"

#include <algorithm>
#include <utility>

#include "runtime/problem/observers.hpp"
#include "runtime/proof/format.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kBoxesOfPavingRound = 256;
constexpr double kSlackOfResolution = 1 + 0x1p-30;

/// The goal of the search: box_search.hpp. The boxes of the branch are judged, and halved where neither
/// is shown. The last box that was made is judged first.
class ValuePavingGoal {
 public:
  static constexpr bool kJudgesWhenMade = false;

  ValuePavingGoal(BoxCourse& course, const ValueQuestion& question, const ClosureResult& branch,
                  const ValueAim& aim, double resolution, const IsPossible& is_possible,
                  const ForceListener& listener)
      : course_(course),
        question_(question),
        branch_(branch),
        aim_(aim),
        resolution_(resolution),
        is_possible_(is_possible),
        listener_(listener) {
    for (std::size_t k = 0; k < question.closure.shape.parameters; ++k)
      ranges_.push_back(width_ru(question.problem.outer[k]));
  }

  /// The splits of the branch are made again.
  void start(TreeBox root) {
    const BranchTree& tree = branch_.branch.tree;
    std::vector<std::pair<TreeBox, BoxId>> waiting;
    waiting.emplace_back(std::move(root), 0);
    while (!waiting.empty()) {
      auto [box, id] = std::move(waiting.back());
      waiting.pop_back();
      const BranchTree::Node& node = tree.node(id);
      if (node.variable == BranchTree::kNone) {
        reopen(std::move(box));
        continue;
      }
      auto [lower, upper] = course_.split(std::move(box), node.variable);
      waiting.emplace_back(std::move(upper), node.lower + 1);
      waiting.emplace_back(std::move(lower), node.lower);
    }
  }

  [[nodiscard]] bool has_ended() const { return open_.empty(); }
  void fill(std::vector<std::vector<Interval>>& boxes, std::uint64_t left) {
    round_.clear();
    course_.take_round(open_, kBoxesOfPavingRound, left, round_, boxes,
                       [this](SavedTree& tree) { describe(tree); });
  }
  [[nodiscard]] double horizon() const { return 0; }
  [[nodiscard]] std::size_t open() const { return open_.size(); }

  void conclude(std::span<ValueFinding> findings) {
    for (std::size_t i = round_.size(); i-- > 0;) {
      note_value(round_[i].id, findings[i]);
      conclude(std::move(round_[i]), findings[i]);
    }
  }

  [[nodiscard]] std::size_t splittable() const { return ranges_.size(); }
  void describe(SavedTree& tree) const {
    for (const TreeBox& box : open_) tree.add_open(box.id, kInfinity);
    if (result_.place) tree.shown = {shown_in_};
  }
  void recall(const TreeBox& box, ValueFinding& finding) { note_value(box.id, finding); }
  /// The splits of the branch, and its leaves that need no finding, are no boxes of this search.
  void resume_own(std::span<const std::uint64_t>) {
    const BranchTree& tree = branch_.branch.tree;
    std::uint64_t made = tree.splits().size();
    for (std::size_t leaf = 0; leaf < tree.leaves().size(); ++leaf)
      if (!is_on_branch(leaf)) ++made;
    if (course_.boxes() < made) throw SavedTreeError("the tree is not one of this branch");
    course_.recount(course_.boxes() - made);
  }
  /// A leaf that its finding does not decide is judged again.
  void resume(TreeBox box, ValueFinding& finding, bool) {
    if (is_decided_by_branch(box) || !leave_decided(box, finding)) reopen(std::move(box));
  }
  /// A box that is not on the branch needs no finding.
  void reopen(TreeBox box) {
    const std::optional<std::size_t> leaf = leaf_of(box.box);
    if (!leaf) throw SavedTreeError("a box is not a part of one of the branch");
    if (branch_.branch.tree.leaves()[*leaf].is_outside)
      return leave(std::move(box), ForceClaim::kOutside);
    if (!is_on_branch(*leaf)) return leave(std::move(box), ForceClaim::kUndecided);
    open_.push_back(std::move(box));
  }

  BranchPaving finish() {
    result_.is_feasible = open_.empty() && is_feasible_ && !course_.lacks_memory();
    result_.is_empty = open_.empty() && is_empty_;
    for (TreeBox& box : open_) {
      course_.leave_open(box, Rule::kBlocked);
      listener_(box.box, ForceClaim::kUndecided);
      keep(std::move(box), ForceClaim::kUndecided, {});
    }
    result_.stopped_by = course_.stopped_by();
    result_.boxes = course_.boxes();
    result_.seconds = course_.seconds();
    course_.tell_end();
    return std::move(result_);
  }
  /// Returns the leaves of the tree.
  [[nodiscard]] std::vector<BranchLeaf> take_leaves() { return std::move(leaves_); }

 private:
  [[nodiscard]] std::optional<std::size_t> leaf_of(std::span<const Interval> box) const {
    return branch_.branch.tree.leaf_with(box);
  }
  [[nodiscard]] bool is_on_branch(std::size_t leaf) const {
    return leaf < branch_.links.on_branch.size() && branch_.links.on_branch[leaf] != 0 &&
           branch_.branch.tree.leaves()[leaf].tube.has_value();
  }
  [[nodiscard]] bool is_decided_by_branch(const TreeBox& box) const {
    const std::optional<std::size_t> leaf = leaf_of(box.box);
    return !leaf || !is_on_branch(*leaf);
  }
  [[nodiscard]] bool is_of_leaf(const BranchTube& tube, std::size_t leaf,
                                std::span<const double> near = {}) const {
    return holds_solutions_of(*branch_.branch.tree.leaves()[leaf].tube, tube, near);
  }

  [[nodiscard]] std::optional<std::size_t> variable_to_split(const TreeBox& box) const {
    return choose_variable(std::span(box.box).first(ranges_.size()), ranges_, {},
                           resolution_ * kSlackOfResolution);
  }

  void conclude(TreeBox box, const ValueFinding& finding) {
    if (leave_decided(box, finding)) return;
    auto [lower, upper] = course_.split(std::move(box), variable_to_split(box).value());
    open_.push_back(std::move(upper));
    open_.push_back(std::move(lower));
  }

  /// Leaves a box that is not to be split, and returns if it is none.
  bool leave_decided(TreeBox& box, const ValueFinding& finding) {
    const std::size_t leaf = leaf_of(box.box).value();
    const std::optional<BranchTube>& tube = finding.tube.tube;
    const bool is_known = tube && is_of_leaf(*tube, leaf, finding.near_center);
    if (finding.tube.is_outside)
      leave(std::move(box), ForceClaim::kOutside);
    else if (is_known && finding.upper < *aim_.below)
      leave(std::move(box), ForceClaim::kFeasible, tube);
    else if (is_known && finding.lower >= *aim_.from)
      leave(std::move(box), ForceClaim::kInfeasible, tube);
    else if (!variable_to_split(box))
      leave(std::move(box), ForceClaim::kUndecided);
    else
      return false;
    return true;
  }

  void leave(TreeBox box, ForceClaim claim, const std::optional<BranchTube>& tube = {}) {
    is_feasible_ =
        is_feasible_ && (claim == ForceClaim::kFeasible || claim == ForceClaim::kOutside);
    is_empty_ = is_empty_ && claim == ForceClaim::kOutside;
    const Rule rule = claim == ForceClaim::kFeasible     ? Rule::kHMatrix
                      : claim == ForceClaim::kInfeasible ? Rule::kWitness
                      : claim == ForceClaim::kOutside    ? Rule::kOutside
                                                         : Rule::kBlocked;
    course_.leaf(box, rule);
    listener_(box.box, claim);
    keep(std::move(box), claim, tube);
  }

  /// An undecided or excluded box keeps the tube of the branch, if it is on the branch.
  void keep(TreeBox box, ForceClaim claim, std::optional<BranchTube> tube) {
    const char* word = claim == ForceClaim::kFeasible     ? format::kFeasibleLeaf
                       : claim == ForceClaim::kInfeasible ? format::kInfeasibleLeaf
                       : claim == ForceClaim::kOutside    ? format::kOutsideLeaf
                                                          : format::kUndecidedLeaf;
    const std::optional<std::size_t> leaf = leaf_of(box.box);
    const bool has_no_claim = claim == ForceClaim::kUndecided || claim == ForceClaim::kOutside;
    if (has_no_claim && leaf && is_on_branch(*leaf)) {
      word = format::kTubeLeaf;
      tube = branch_.branch.tree.leaves()[*leaf].tube;
    }
    result_.words.push_back(word);
    leaves_.push_back({std::move(box), std::move(tube), claim == ForceClaim::kOutside});
  }

  /// Keeps the first place where the value is certainly beyond the limit.
  void note_value(BoxId id, const ValueFinding& finding) {
    if (result_.place || !finding.middle || !(finding.attained >= *aim_.from)) return;
    const BranchTube& tube = *finding.middle;
    std::optional<std::vector<Interval>> place =
        possible_place(question_.problem, tube, is_possible_);
    if (!place) return;
    const std::vector<std::size_t> leaves = branch_.branch.tree.leaves_at(*place);
    if (leaves.empty() || !std::ranges::all_of(leaves, [&](std::size_t leaf) {
          return is_on_branch(leaf) && is_of_leaf(tube, leaf);
        }))
      return;
    result_.place = tube;
    result_.at = std::move(*place);
    shown_in_ = id;
  }

  BoxCourse& course_;
  const ValueQuestion& question_;
  const ClosureResult& branch_;
  const ValueAim& aim_;
  const double resolution_;
  const IsPossible& is_possible_;
  const ForceListener& listener_;
  std::vector<double> ranges_;  ///< of the motion parameters
  std::vector<TreeBox> open_, round_;
  bool is_feasible_ = true, is_empty_ = true;
  BoxId shown_in_ = 0;
  std::vector<BranchLeaf> leaves_;
  BranchPaving result_;
};

}  // namespace

void BranchPaving::name_excluded() {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const BranchLeaf& leaf = tree.leaves()[i];
    if (leaf.is_outside) words[i] = leaf.tube ? format::kTubeLeaf : format::kOutsideLeaf;
  }
}

BranchPaving pave_values(const ValueQuestion& question, const ClosureResult& branch,
                         const ValueAim& aim, double resolution, const BoxSearchSettings& settings,
                         const IsPossible& is_possible, const ForceListener& listener,
                         Observer* progress) {
  BranchTree tree;
  SplitRecorder recorder(tree);
  Observers observers(present({&recorder, progress}));
  BoxCourse course(question.problem, settings, &observers);
  ValuePavingGoal goal(course, question, branch, aim, resolution, is_possible, listener);
  BoxSearch<ValueJudge, ValuePavingGoal>(question, kBoxesOfPavingRound, course, goal).run();
  BranchPaving paving = goal.finish();
  for (BranchLeaf& leaf : goal.take_leaves()) tree.leave(std::move(leaf));
  paving.tree = std::move(tree);
  return paving;
}

}  // namespace regulus::detail
