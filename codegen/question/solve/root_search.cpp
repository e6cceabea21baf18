// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/root_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "codegen/question/engine/search_topic.hpp"
#include "codegen/question/solve/retraced_roots.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kBoxesOfRound = 64;
/// A search of so many boxes has rounds that keep many workers busy.
constexpr std::uint64_t kBoxesBeforeLongRounds = BoxSharing{}.boxes_before;
constexpr std::size_t kBoxesOfLongRound = 2048;

/// The goal of the search: box_search.hpp. The last box that was made is judged first.
class RootGoal {
 public:
  static constexpr bool kJudgesWhenMade = false;

  RootGoal(BoxCourse& course, const RootQuestion& question, const RootSettings& settings)
      : course_(course), settings_(settings), shape_(question.shape) {
    for (std::size_t k = 0; k < shape_.variables + shape_.unknowns; ++k)
      ranges_.push_back(k < shape_.variables ? kInfinity : width_ru(question.problem.outer[k]));
  }

  void start(TreeBox root) { open_.push_back(std::move(root)); }
  [[nodiscard]] bool has_ended() const {
    return open_.empty() || (!list_.open.empty() && course_.boxes() >= last_box_);
  }

  void fill(std::vector<std::vector<Interval>>& boxes, std::uint64_t left) {
    round_.clear();
    const bool is_long = course_.boxes() >= kBoxesBeforeLongRounds;
    course_.take_round(open_, is_long ? kBoxesOfLongRound : kBoxesOfRound, left, round_, boxes,
                       [this](SavedTree& tree) { describe(tree); });
  }

  [[nodiscard]] double horizon() const { return 0; }
  [[nodiscard]] std::size_t open() const { return open_.size(); }

  void conclude(std::span<RootFinding> findings) {
    for (std::size_t i = round_.size(); i-- > 0;) conclude(round_[i], findings[i]);
  }

  void describe(SavedTree& tree) const {
    for (const TreeBox& box : open_) tree.add_open(box.id, kInfinity);
    tree.own = {last_box_};
  }
  bool retrace(const SavedTree& from, const RetracedRoots::JudgeMany& judge) {
    const TreeBox root = course_.root();
    const RestoredTree tree(from, root.box, ranges_.size(), Splits::kByCuts);
    RetracedRoots retraced(
        tree, [this](auto& box, const RootFinding& found) { return narrow(box, found); });
    if (!retraced.prove(root.box, judge)) return false;
    course_.count(tree.steps().size());
    repeat(tree, retraced);
    if (from.own.size() != 1) throw SavedTreeError("it has other numbers of its own");
    if (!list_.open.empty()) last_box_ = from.own.front();
    return true;
  }

  RootList finish() {
    for (const TreeBox& box : open_) {
      course_.leave_open(box, Rule::kBlocked);
      list_.open.push_back(unknowns_of(box));
    }
    list_.boxes = course_.boxes();
    list_.seconds = course_.seconds();
    list_.stopped_by = course_.stopped_by();
    if (course_.lacks_memory()) list_.stopped_by = Reason::kMemory;
    list_.is_complete = list_.open.empty() && !list_.stopped_by;
    course_.tell_end();
    return std::move(list_);
  }

 private:
  void conclude(TreeBox& box, RootFinding& finding) {
    const auto variable = narrow(box.box, finding);
    if (!variable) return leave(box, finding);
    const double middle = mid(box.box[*variable]);
    auto [lower, upper] = course_.split(std::move(box), *variable, middle);
    open_.push_back(std::move(upper));
    open_.push_back(std::move(lower));
  }

  /// Leaves of a box what may have solutions. Returns the variable in which that is halved; nullopt:
  /// the box is a leaf.
  [[nodiscard]] std::optional<std::size_t> narrow(std::vector<Interval>& box,
                                                  const RootFinding& finding) const {
    if (finding.is_empty || finding.root) return std::nullopt;
    std::ranges::copy(finding.unknowns, box.begin() + std::ptrdiff_t(shape_.variables));
    if (finding.is_regular) return std::nullopt;
    return choose_variable(box, ranges_, finding.impact, settings_.min_relative_width);
  }

  /// A leaf that is not empty has a bound in the file, so that it is judged as it is here.
  void leave(const TreeBox& box, RootFinding& finding) {
    if (finding.is_empty) return course_.leaf(box, Rule::kOutside);
    if (finding.root)
      list_.roots.push_back(std::move(*finding.root));
    else if (finding.is_regular)
      list_.regular.push_back(unknowns_of(box));
    else
      return block(box, finding);
    course_.leaf(box, Rule::kSecondOrder, 0);
  }

  void block(const TreeBox& box, const RootFinding& finding) {
    if (list_.open.empty()) last_box_ = course_.boxes() + settings_.boxes_after_problem;
    list_.is_undefined = list_.is_undefined || finding.is_undefined;
    list_.open.push_back(unknowns_of(box));
    course_.leaf(box, Rule::kBlocked, 0);
  }

  /// Makes the splits and leaves again, in their order.
  void repeat(const RestoredTree& tree, RetracedRoots& retraced) {
    for (const RestoredTree::Step& step : tree.steps()) {
      TreeBox box{step.box, tree.depth(step.box), tree.box(step.box)};
      if (step.variable) {
        static_cast<void>(course_.split(std::move(box), *step.variable, step.at));
      } else if (RetracedRoots::Leaf* const leaf = retraced.leaf(step.box)) {
        box.box = leaf->box;
        leave(box, leaf->finding);
      } else {
        course_.leaf(box, Rule::kOutside);
      }
    }
    const auto open = std::span(tree.leaves()).last(tree.open());
    for (const RestoredTree::Leaf& leaf : open)
      open_.push_back({leaf.box, tree.depth(leaf.box), retraced.leaf(leaf.box)->box});
  }

  [[nodiscard]] std::vector<Interval> unknowns_of(const TreeBox& box) const {
    return {box.box.begin() + std::ptrdiff_t(shape_.variables), box.box.end()};
  }

  BoxCourse& course_;
  const RootSettings& settings_;
  const ClosedShape shape_;
  std::vector<double> ranges_;
  std::vector<TreeBox> open_, round_;
  std::uint64_t last_box_ = 0;
  RootList list_;
};

/// Returns the values of `root`, moved by whole periods to be near those of `other`.
std::vector<Interval> moved_to(const Root& root, const Root& other,
                               const std::vector<Interval>& periods) {
  std::vector<Interval> values = root.values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (periods[i] == Interval(0.0)) continue;
    const double turns = std::round((mid(other.values[i]) - mid(values[i])) / mid(periods[i]));
    values[i] += Interval(turns) * periods[i];
  }
  return values;
}

enum class Same { kYes, kNo, kUnknown };

Same are_same(const Root& a, const Root& b, const std::vector<Interval>& periods) {
  const std::vector<Interval> near = moved_to(b, a, periods);
  if (a.is(near) || b.is(moved_to(a, b, periods))) return Same::kYes;
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (!certain_disjoint(near[i], a.values[i])) continue;
    if (periods[i] == Interval(0.0)) return Same::kNo;
    // Two turns and more lead far away.
    if (mag(near[i] - a.values[i]) < mig(periods[i]) &&
        certain_disjoint(near[i] + periods[i], a.values[i]) &&
        certain_disjoint(near[i] - periods[i], a.values[i]))
      return Same::kNo;
  }
  return Same::kUnknown;
}

/// Keeps one of those that are the same.
void keep_different(RootList& list, const std::vector<Interval>& periods) {
  std::vector<Root> kept;
  for (Root& root : list.roots) {
    Same same = Same::kNo;
    for (const Root& other : kept)
      if (same = are_same(other, root, periods); same != Same::kNo) break;
    if (same == Same::kUnknown) {
      list.is_doubtful = true;
      list.open.push_back(root.values);
    }
    if (same == Same::kNo) kept.push_back(std::move(root));
  }
  list.roots = std::move(kept);
  list.is_complete = list.is_complete && !list.is_doubtful;
}

}  // namespace

RootList search_roots(const RootQuestion& question, const std::vector<Interval>& periods,
                      const RootSettings& settings, Observer* progress) {
  if (settings.workers != nullptr) {
    SearchTopic topic;
    topic.piece = question.number;
    settings.workers->turn_to(write_topic(topic));
  }
  const RootSearch search = [&](const RootSettings& own) {
    BoxCourse course(question.problem, own, progress);
    RootGoal goal(course, question, own);
    BoxSearch<RootJudge, RootGoal>(question, kBoxesOfRound, course, goal).run();
    RootList list = goal.finish();
    keep_different(list, periods);
    return list;
  };
  return settings.keep ? settings.keep(settings, search) : search(settings);
}

}  // namespace regulus::detail
