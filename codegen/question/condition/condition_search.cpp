// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/condition_search.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

namespace regulus::detail {
namespace {

/// The boxes that are split in a round: a part of those that are open, so that few of them are split
/// in vain, within these bounds.
constexpr std::size_t kPartOfOpen = 8, kFewestParents = 32, kMostParents = 1024;
/// If no bound is known after so many boxes, a singular pose is likely, or one that is nearly so.
constexpr std::uint64_t kBoxesBeforeDoubt = 1024;

/// A box that is not split yet.
struct BoundedBox {
  TreeBox at;
  double upper = kInfinity;
  std::vector<double> impact{};
  bool is_undefined = false;

  /// The largest bound first; among equal ones the first that was made.
  friend bool operator<(const BoundedBox& a, const BoundedBox& b) noexcept {
    return a.upper < b.upper || (a.upper == b.upper && a.at.id > b.at.id);
  }
};

struct BoundedBoxes : std::priority_queue<BoundedBox> {
  [[nodiscard]] const std::vector<BoundedBox>& in_any_order() const { return c; }
};

/// The goal of the search: box_search.hpp. The box with the largest bound is split first.
class ConditionGoal {
 public:
  static constexpr bool kJudgesWhenMade = true;

  ConditionGoal(BoxCourse& course, const Problem& problem, const ConditionSettings& settings)
      : course_(course), settings_(settings) {
    for (std::size_t v = 0; v < problem.outer.size(); ++v) {
      const bool is_idle = v < problem.idle.size() && problem.idle[v] != 0;
      ranges_.push_back(is_idle ? kInfinity : width_ru(problem.outer[v]));
    }
  }

  void start(TreeBox root) { open_.push({std::move(root)}); }

  [[nodiscard]] bool has_ended() const {
    if (attained() == kInfinity || result_.is_singular) return true;
    if (settings_.limit && attained() >= settings_.limit->hi) return true;
    return is_settled() || (!is_low(settled_) && open_.top().upper <= settled_);
  }

  void fill(std::vector<std::vector<Interval>>& boxes, std::uint64_t) {
    children_.clear();
    if (course_.boxes() == 0) {
      add(open_.top(), boxes);
      return open_.pop();
    }
    if (course_.boxes() >= kBoxesBeforeDoubt && proved() == kInfinity) ask();
    if (result_.is_singular) return;
    const std::size_t most =
        2 * std::clamp(open_.size() / kPartOfOpen, kFewestParents, kMostParents);
    while (children_.size() < most && !is_settled()) split_largest(boxes);
  }

  [[nodiscard]] double horizon() const { return attained(); }
  [[nodiscard]] std::size_t open() const { return open_.size(); }

  void conclude(std::span<BoxFinding> findings) {
    for (std::size_t i = 0; i < children_.size(); ++i) conclude(children_[i], findings[i]);
  }

  [[nodiscard]] std::size_t splittable() const { return ranges_.size(); }
  void describe(SavedTree& tree) const {
    std::vector<const BoundedBox*> open;
    for (const BoundedBox& box : open_.in_any_order()) open.push_back(&box);
    std::ranges::sort(open, {}, [](const BoundedBox* box) { return box->at.id; });
    for (const BoundedBox* box : open) tree.add_open(box->at.id, box->upper);
    if (result_.attained) tree.shown = {attained_in_};
    tree.own = {was_told_ ? 1U : 0U};
  }

  void recall(const TreeBox& box, BoxFinding& finding) { attain(box.id, finding.attained); }

  /// A later run asks again what an earlier one was told.
  void resume_own(std::span<const std::uint64_t> own) {
    if (own.size() != 1 || own[0] > 1) throw SavedTreeError("the numbers of the search are wrong");
    if (own[0] == 1) ask();
    was_told_ = own[0] == 1;
  }

  /// With another gap, a box may be split that was not split any more.
  void resume(TreeBox at, BoxFinding& finding, bool is_leaf) {
    if (finding.is_outside) return exclude(at);
    BoundedBox box{std::move(at), finding.bound.upper, std::move(finding.bound.impact),
                   finding.is_undefined};
    if (is_leaf && is_low(box.upper)) return settle(box);
    if (is_leaf && !choose(box)) return give_up(box);
    open_.push(std::move(box));
  }

  void reopen(TreeBox box) { start(std::move(box)); }

  ConditionResult finish() {
    const std::optional<Reason> stopped = course_.stopped_by();
    if (stopped) result_.reason = *stopped;
    if (attained() == kInfinity) result_.is_singular = true;
    if (!result_.is_singular && proved() == kInfinity) ask();
    result_.proved = result_.is_singular || course_.lacks_memory() ? kInfinity : proved();
    result_.is_by_hint = known_ < proved_by_boxes();
    result_.is_empty = open_.empty() && is_empty_;
    const bool is_exceeded = settings_.limit && attained() >= settings_.limit->hi;
    result_.is_closed = !result_.is_empty && (is_exceeded || is_low(result_.proved));
    result_.is_continued = course_.is_continued();
    result_.boxes = course_.boxes();
    result_.seconds = course_.seconds();
    for (; !open_.empty(); open_.pop()) course_.leave_open(open_.top().at, Rule::kSecondOrder);
    course_.tell_end();
    return std::move(result_);
  }

 private:
  [[nodiscard]] double attained() const {
    return result_.attained ? result_.attained->shown.condition : 0;
  }
  /// κ is below that everywhere.
  [[nodiscard]] double proved() const { return std::min(proved_by_boxes(), known_); }
  [[nodiscard]] double proved_by_boxes() const {
    return open_.empty() ? settled_ : std::max(settled_, open_.top().upper);
  }
  /// Returns true if a box with this bound need not be split.
  [[nodiscard]] bool is_low(double upper) const {
    upper = std::min(upper, known_);
    if (settings_.limit) return upper <= settings_.limit->lo;
    return std::isfinite(upper) && upper - attained() <= settings_.gap * upper;
  }
  [[nodiscard]] bool is_settled() const { return open_.empty() || is_low(open_.top().upper); }

  /// A later run asks again if there was no answer: it may have more time.
  void ask() {
    if (has_asked_ || !settings_.ask || course_.stopped_by() == Reason::kInterrupted) return;
    has_asked_ = true;
    const ConditionHint hint = settings_.ask(settings_.time_limit - course_.seconds());
    result_.is_singular = hint.is_singular;
    known_ = hint.upper;
    if (hint.is_singular || hint.upper < kInfinity) was_told_ = true;
  }

  void split_largest(std::vector<std::vector<Interval>>& boxes) {
    BoundedBox parent = open_.top();
    open_.pop();
    const std::optional<std::size_t> variable = choose(parent);
    if (!variable) return give_up(parent);
    auto [lower, upper] = course_.split(std::move(parent.at), *variable);
    add({std::move(lower), parent.upper}, boxes);
    add({std::move(upper), parent.upper}, boxes);
  }

  void add(BoundedBox child, std::vector<std::vector<Interval>>& boxes) {
    boxes.push_back(child.at.box);
    children_.push_back(std::move(child));
  }

  [[nodiscard]] std::optional<std::size_t> choose(const BoundedBox& box) const {
    return choose_variable(box.at.box, ranges_, box.impact, settings_.min_relative_width);
  }

  void conclude(BoundedBox& child, BoxFinding& finding) {
    if (finding.is_outside) return exclude(child.at);
    attain(child.at.id, finding.attained);
    child.upper = std::min(child.upper, finding.bound.upper);
    child.impact = std::move(finding.bound.impact);
    child.is_undefined = finding.is_undefined;
    if (is_low(child.upper))
      settle(child);
    else
      open_.push(std::move(child));
  }

  void attain(BoxId box, std::optional<ConditionWitness>& witness) {
    if (!witness || !(witness->shown.condition > attained())) return;
    result_.attained = std::move(witness);
    attained_in_ = box;
  }

  void exclude(const TreeBox& box) { course_.leaf(box, Rule::kOutside); }
  /// The box keeps its bound.
  void settle(const BoundedBox& box) {
    is_empty_ = false;
    settled_ = std::max(settled_, box.upper);
    course_.leaf(box.at, Rule::kSecondOrder, box.upper);
  }
  /// The box cannot be split.
  void give_up(const BoundedBox& box) {
    if (box.upper > settled_)
      result_.reason = box.is_undefined ? Reason::kUndefined : Reason::kWidth;
    settle(box);
  }

  BoxCourse& course_;
  const ConditionSettings& settings_;
  std::vector<double> ranges_;
  BoundedBoxes open_;
  std::vector<BoundedBox> children_;  ///< of the round, in the order of their numbers
  double known_ = kInfinity;          ///< κ is below that everywhere
  double settled_ = 0;  ///< the largest bound of all boxes that are not split any more
  bool is_empty_ = true, has_asked_ = false, was_told_ = false;
  BoxId attained_in_ = 0;
  ConditionResult result_;
};

template <class Judge>
ConditionResult search_with(const typename Judge::Question& question,
                            const ConditionSettings& settings, Observer* progress) {
  BoxCourse course(question.problem, settings, progress);
  ConditionGoal goal(course, question.problem, settings);
  BoxSearch<Judge, ConditionGoal>(question, 2 * kMostParents, course, goal).run();
  return goal.finish();
}

}  // namespace

ConditionResult search_condition(const ConditionQuestion& question,
                                 const ConditionSettings& settings, Observer* progress) {
  return search_with<BoxJudge>(question, settings, progress);
}

ConditionResult search_condition(const PathConditionQuestion& question,
                                 const ConditionSettings& settings, Observer* progress) {
  return search_with<PathJudge>(question, settings, progress);
}

}  // namespace regulus::detail
