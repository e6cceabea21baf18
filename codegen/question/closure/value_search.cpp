// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/value_search.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "runtime/problem/observers.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kMostSplit = 32;
constexpr double kLeastPart = 0x1p-30;  ///< of a range: boxes are not split further
constexpr std::size_t kOwnNumbers = 4;  ///< of a search that is kept
constexpr std::size_t kMostSides = 6;   ///< of each so many ranges the corners are looked at before

/// A box that is not split yet, with the leaf of the branch that it is a part of.
struct ValueBox {
  TreeBox at;
  std::size_t leaf = 0;
  double upper = kInfinity;
  std::optional<BranchTube> tube{};
  std::vector<double> impact{};
  bool is_judged = false;

  friend bool operator<(const ValueBox& a, const ValueBox& b) noexcept {
    return a.upper < b.upper || (a.upper == b.upper && a.at.id > b.at.id);
  }
};

struct ValueBoxes : std::priority_queue<ValueBox> {
  [[nodiscard]] const std::vector<ValueBox>& in_any_order() const { return c; }
};

/// A corner of the ranges.
struct Corner {
  std::size_t number = 0;  ///< from 1
  std::vector<Interval> at;
};

/// The goal of the search: box_search.hpp. The box with the largest bound is split first.
class ValueGoal {
 public:
  static constexpr bool kJudgesWhenMade = false;

  ValueGoal(BoxCourse& course, const ValueQuestion& question, const BranchTree& branch,
            const ValueAim& aim, const IsPossible& is_possible, ValueBracket& result)
      : course_(course),
        question_(question),
        branch_(branch),
        aim_(aim),
        is_possible_(is_possible),
        result_(result) {
    result.attained = aim.attained;
    for (std::size_t k = 0; k < question.closure.shape.variables; ++k)
      ranges_.push_back(width_ru(question.problem.outer[k]));
  }

  /// The splits of the branch are made again.
  void start(TreeBox root) {
    corners_ = corners_of(root.box);
    std::vector<std::pair<TreeBox, BoxId>> waiting;
    waiting.emplace_back(std::move(root), 0);
    while (!waiting.empty()) {
      auto [box, id] = std::move(waiting.back());
      waiting.pop_back();
      const BranchTree::Node& node = branch_.node(id);
      if (node.variable != BranchTree::kNone) {
        auto [lower, upper] = course_.split(std::move(box), node.variable);
        waiting.emplace_back(std::move(upper), node.lower + 1);
        waiting.emplace_back(std::move(lower), node.lower);
      } else if (branch_.leaves().at(node.leaf).tube) {
        open_.push({std::move(box), node.leaf, kInfinity, branch_.leaves()[node.leaf].tube});
      } else {
        exclude(std::move(box), {});
      }
    }
  }

  [[nodiscard]] bool has_ended() const {
    return corners_.empty() && (open_.empty() || is_enough(open_.top().upper));
  }

  void fill(std::vector<std::vector<Interval>>& boxes, std::uint64_t left) {
    round_.clear(), corners_of_round_.clear();
    if (left < 2 * kMostSplit) course_.save_last([this](SavedTree& tree) { describe(tree); });
    const std::size_t most = std::min<std::uint64_t>(2 * kMostSplit, left);
    if (!corners_.empty()) is_corner_again_ = false;
    while (!corners_.empty() && boxes.size() < most) {
      boxes.push_back(std::move(corners_.back().at));
      corners_of_round_.push_back(corners_.back().number);
      corners_.pop_back();
    }
    while (corners_of_round_.empty() && round_.size() + 1 < most && !open_.empty() &&
           !is_enough(open_.top().upper))
      take(boxes);
  }

  [[nodiscard]] double horizon() const { return 0; }
  [[nodiscard]] std::size_t open() const { return open_.size(); }

  void conclude(std::span<ValueFinding> findings) {
    for (std::size_t i = 0; i < corners_of_round_.size(); ++i)
      note_value(findings[i], 0, corners_of_round_[i]);
    for (std::size_t i = 0; i < round_.size(); ++i) {
      ValueBox& box = round_[i];
      const ValueFinding& finding = findings[i];
      if (finding.tube.is_outside) {
        exclude(std::move(box.at), std::move(box.tube));
        continue;
      }
      box.is_judged = true;
      if (finding.tube.tube && is_on_branch(*finding.tube.tube, box.leaf, finding.near_center)) {
        box.tube = finding.tube.tube;
        box.upper = std::fmin(box.upper, finding.upper);
        box.impact = finding.impact;
        note_value(finding, box.at.id, 0);
      }
      open_.push(std::move(box));
    }
  }

  [[nodiscard]] std::size_t splittable() const { return ranges_.size(); }
  /// The boxes that are not judged are the last ones.
  void describe(SavedTree& tree) const {
    std::vector<const ValueBox*> open;
    for (const ValueBox& box : open_.in_any_order()) open.push_back(&box);
    std::ranges::sort(open, {},
                      [](const ValueBox* b) { return std::pair(!b->is_judged, b->at.id); });
    for (const ValueBox* box : open) tree.add_open(box->at.id, box->upper);
    if (shown_in_ != 0) tree.shown = {shown_in_ - 1};
    const auto unjudged = std::uint64_t(std::ranges::count(open, false, &ValueBox::is_judged));
    const std::uint64_t again = is_corner_again_ ? 1 : 0;
    tree.own = {unjudged, corners_.size() - again, corner_shown_, course_.boxes() + again};
  }
  [[nodiscard]] std::size_t reopened(std::span<const std::uint64_t> own, std::size_t) const {
    if (own.size() != kOwnNumbers) throw SavedTreeError("the numbers of the search are missing");
    return own[0];
  }
  /// Forgets a finding whose tube is not shown to be of the branch.
  void revise(const std::vector<Interval>& box, ValueFinding& finding) const {
    if (finding.tube.is_outside) return;
    const std::optional<std::size_t> leaf = branch_.leaf_with(box);
    if (!leaf || !branch_.leaves()[*leaf].tube || !finding.tube.tube ||
        !is_on_branch(*finding.tube.tube, *leaf, finding.near_center))
      finding = {};
  }
  void recall(const TreeBox& box, ValueFinding& finding) { note_value(finding, box.id, 0); }
  /// The corner that showed more than all boxes is judged again.
  void resume_own(std::span<const std::uint64_t> own) {
    std::vector<Corner> all = corners_of(question_.problem.outer);
    const std::size_t left = own[1];
    corner_shown_ = own[2];
    if (left > all.size() || corner_shown_ > all.size())
      throw SavedTreeError("there are not so many corners");
    corners_.assign(all.begin(), all.begin() + std::ptrdiff_t(left));
    is_corner_again_ = corner_shown_ > left;
    if (is_corner_again_) corners_.push_back(all[corner_shown_ - 1]);
    course_.recount(own[3] - std::min<std::uint64_t>(own[3], is_corner_again_ ? 1 : 0));
  }
  void resume(TreeBox at, ValueFinding& finding, bool is_leaf) {
    ValueBox box = box_of(std::move(at));
    if (!box.tube || finding.tube.is_outside)
      return exclude(std::move(box.at), std::move(box.tube));
    if (finding.tube.tube) box.tube = std::move(finding.tube.tube);
    box.upper = finding.upper;
    box.impact = std::move(finding.impact);
    box.is_judged = true;
    if (is_leaf && !variable_of(box)) return settle(box);
    open_.push(std::move(box));
  }
  void reopen(TreeBox at) {
    ValueBox box = box_of(std::move(at));
    if (!box.tube) return exclude(std::move(box.at), {});
    open_.push(std::move(box));
  }

  /// Returns the leaves of the tree.
  std::vector<BranchLeaf> finish() {
    double upper = settled_;
    if (!open_.empty()) upper = std::fmax(upper, open_.top().upper);
    result_.upper = course_.lacks_memory() ? kInfinity : upper;
    result_.is_closed = is_enough(result_.upper);
    if (!result_.is_closed) result_.stopped_by = course_.stopped_by();
    for (; !open_.empty(); open_.pop()) leave(open_.top());
    result_.boxes = course_.boxes();
    result_.seconds = course_.seconds();
    course_.tell_end();
    return std::move(leaves_);
  }

 private:
  [[nodiscard]] bool is_enough(double upper) const { return aim_.is_met(result_.attained, upper); }

  void take(std::vector<std::vector<Interval>>& boxes) {
    ValueBox box = open_.top();
    open_.pop();
    if (!box.is_judged) return add(std::move(box), boxes);
    const auto variable = variable_of(box);
    if (!variable) return settle(box);
    auto [lower, upper] = course_.split(std::move(box.at), *variable);
    add({std::move(lower), box.leaf, box.upper, box.tube}, boxes);
    add({std::move(upper), box.leaf, box.upper, box.tube}, boxes);
  }

  void add(ValueBox box, std::vector<std::vector<Interval>>& boxes) {
    boxes.push_back(box.at.box);
    round_.push_back(std::move(box));
  }

  [[nodiscard]] std::optional<std::size_t> variable_of(const ValueBox& box) const {
    return choose_variable(box.at.box, ranges_, box.impact, kLeastPart);
  }
  /// Returns a box of the branch without a finding. Throws SavedTreeError if it is none.
  [[nodiscard]] ValueBox box_of(TreeBox at) const {
    const std::optional<std::size_t> leaf = branch_.leaf_with(at.box);
    if (!leaf) throw SavedTreeError("a box is not a part of one of the branch");
    return {std::move(at), *leaf, kInfinity, branch_.leaves()[*leaf].tube};
  }

  /// The box is not split any more.
  void settle(const ValueBox& box) {
    settled_ = std::fmax(settled_, box.upper);
    course_.leaf(box.at, Rule::kSecondOrder, box.upper);
    leaves_.push_back({box.at, box.tube});
  }
  /// A part of the branch keeps its tube: it may be what joins others with the start.
  void exclude(TreeBox box, std::optional<BranchTube> tube) {
    course_.leaf(box, Rule::kOutside);
    leaves_.push_back({std::move(box), std::move(tube), true});
  }
  void leave(const ValueBox& box) {
    course_.leave_open(box.at, Rule::kSecondOrder);
    leaves_.push_back({box.at, box.tube});
  }

  /// Many quantities are largest at a corner of the ranges.
  [[nodiscard]] std::vector<Corner> corners_of(const std::vector<Interval>& root) const {
    std::vector<Corner> corners;
    std::vector<std::size_t> wide;
    for (std::size_t k = 0; k < ranges_.size(); ++k)
      if (ranges_[k] > 0 && question_.problem.inner[k]) wide.push_back(k);
    const std::size_t sides = std::min(wide.size(), kMostSides);
    for (std::size_t corner = 0; corner < std::size_t{1} << sides; ++corner) {
      std::vector<Interval> box = root;
      for (std::size_t i = 0; i < wide.size(); ++i) {
        const Interval& range = *question_.problem.inner[wide[i]];
        box[wide[i]] = Interval((corner >> (i % kMostSides) & 1) != 0 ? range.hi : range.lo);
      }
      corners.push_back({corner + 1, std::move(box)});
    }
    return corners;
  }

  /// `corner`: its number; 0: the finding is about the box `id`.
  void note_value(const ValueFinding& finding, BoxId id, std::size_t corner) {
    if (!finding.middle || !(finding.attained > result_.attained)) return;
    const BranchTube& tube = *finding.middle;
    std::optional<std::vector<Interval>> place =
        possible_place(question_.problem, tube, is_possible_);
    if (!place) return;
    const std::vector<std::size_t> leaves = branch_.leaves_at(*place);
    const bool is_of_branch = !leaves.empty() && std::ranges::all_of(leaves, [&](std::size_t leaf) {
      return branch_.leaves()[leaf].tube && is_on_branch(tube, leaf);
    });
    if (!is_of_branch) return;
    result_.attained = finding.attained;
    result_.place = tube;
    result_.at = std::move(*place);
    corner_shown_ = corner;
    shown_in_ = corner == 0 ? id + 1 : 0;
  }

  [[nodiscard]] bool is_on_branch(const BranchTube& tube, std::size_t leaf,
                                  std::span<const double> near = {}) const {
    return holds_solutions_of(*branch_.leaves()[leaf].tube, tube, near);
  }

  BoxCourse& course_;
  const ValueQuestion& question_;
  const BranchTree& branch_;
  const ValueAim& aim_;
  const IsPossible& is_possible_;
  ValueBracket& result_;
  std::vector<double> ranges_;
  std::vector<Corner> corners_;
  std::vector<std::size_t> corners_of_round_;
  std::uint64_t corner_shown_ = 0;  ///< the number of the corner of `attained`; 0: none
  bool is_corner_again_ = false;    ///< the last of `corners_` was judged by an earlier run
  BoxId shown_in_ = 0;              ///< 1 + the box of `attained`; 0: none
  ValueBoxes open_;
  std::vector<ValueBox> round_;
  std::vector<BranchLeaf> leaves_;
  double settled_ = -kInfinity;
};

}  // namespace

bool ValueAim::is_met(double attained_now, double upper) const {
  if (from) return attained_now >= *from || upper < *below;
  return std::isfinite(upper) && std::isfinite(attained_now) &&
         upper - attained_now <=
             gap * std::max({std::fabs(upper), std::fabs(attained_now), negligible});
}

std::optional<std::vector<Interval>> possible_place(const Problem& problem, const BranchTube& tube,
                                                    const IsPossible& is_possible) {
  std::vector<Interval> place;
  for (std::size_t k = 0; k < tube.at.size(); ++k) {
    const std::optional<Interval>& inner = problem.inner[k];
    place.push_back(inner ? Interval(tube.at[k]) : problem.outer[k]);
    if (inner && !certain_subset(place[k], *inner)) return std::nullopt;
  }
  std::vector<Interval> point = place;
  for (const Interval& p : enclose(tube, place)) point.push_back(p);
  return is_possible(point) ? std::optional(std::move(place)) : std::nullopt;
}

ValueBracket search_value(const ValueQuestion& question, const BranchTree& branch,
                          const ValueAim& aim, const BoxSearchSettings& settings,
                          const IsPossible& is_possible, Observer* progress) {
  ValueBracket result;
  BranchTree tree;
  SplitRecorder recorder(tree);
  Observers observers(present({&recorder, progress}));
  BoxCourse course(question.problem, settings, &observers);
  ValueGoal goal(course, question, branch, aim, is_possible, result);
  BoxSearch<ValueJudge, ValueGoal>(question, 2 * kMostSplit, course, goal).run();
  for (BranchLeaf& leaf : goal.finish()) tree.leave(std::move(leaf));
  result.tree = std::move(tree);
  return result;
}

}  // namespace regulus::detail
