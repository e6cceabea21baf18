// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/branch_links.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "codegen/question/closure/start_test.hpp"
#include "runtime/interval/floating_point_scope.hpp"
#include "runtime/interval/lanes.hpp"

namespace regulus::detail {
namespace {

/// A place at which two tubes, or a tube and the box of the start, must hold one solution.
struct Meeting {
  std::size_t a, b;             ///< leaves; b = kNone: the start
  std::vector<Interval> place;  ///< by variable
  bool is_linked = false;
  bool was_mended = false;  ///< a tube was looked for from the other side
};

/// Joins leaves that are linked.
class Groups {
 public:
  explicit Groups(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t of(std::size_t leaf) {
    while (parent_[leaf] != leaf) leaf = parent_[leaf] = parent_[parent_[leaf]];
    return leaf;
  }
  void join(std::size_t a, std::size_t b) { parent_[of(a)] = of(b); }

 private:
  std::vector<std::size_t> parent_;
};

class Linker {
 public:
  /// One of `start` and `before` is null.
  Linker(const ClosureQuestion& question, BranchTree& tree, const BranchStart* start,
         const BranchBefore* before)
      : question_(question),
        tree_(tree),
        start_(start),
        before_(before),
        system_(question.problem, question.scaling, question.shape),
        finder_(system_, question.shape, question.ranges) {}

  BranchLinks link(const MustStop& must_stop) {
    links_.on_branch.assign(tree_.leaves().size(), 0);
    if (!(before_ == nullptr ? begin() : go_on())) return std::move(links_);
    tree_.for_neighbours(question_.problem.outer,
                         [&](std::size_t a, std::size_t b, const std::vector<Interval>& face) {
                           meetings_.push_back(meeting_of(a, b, face));
                         });
    std::vector<std::size_t> all(meetings_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    meet(all, must_stop);
    mend(must_stop);
    if (const auto reason = must_stop())
      links_.obstacle = describe(*reason);
    else
      conclude();
    if (before_ != nullptr) join(must_stop);
    links_.stopped_by = must_stop();
    return std::move(links_);
  }

  /// Encloses the configuration at the joint.
  std::optional<std::vector<Interval>> configuration_of_before() {
    std::vector<Interval> place;
    for (std::size_t k = 0; k < question_.shape.variables; ++k)
      place.emplace_back(mid(question_.problem.outer[k]));
    place[0] = Interval(before_->end);
    const std::vector<std::size_t> leaves = before_->tree.leaves_at(place);
    if (leaves.empty() || !before_->tree.leaves()[leaves[0]].tube) return std::nullopt;
    const BranchTube& tube = *before_->tree.leaves()[leaves[0]].tube;
    const std::vector<Interval> near = enclose(tube, place);
    auto solution = solution_at(near, with_first(place, before_->begin));
    return solution && certain_holds(tube, place, *solution) ? solution : std::nullopt;
  }

 private:
  [[nodiscard]] const BranchTube& tube(std::size_t leaf) const {
    return *tree_.leaves()[leaf].tube;
  }

  /// The middle of the face; of uncertain quantities, too.
  Meeting meeting_of(std::size_t a, std::size_t b, const std::vector<Interval>& face) const {
    Meeting meeting{a, b, {}, false, false};
    for (std::size_t k = 0; k < question_.shape.variables; ++k)
      meeting.place.emplace_back(mid(face[k]));
    return meeting;
  }

  static std::vector<Interval> with_first(std::vector<Interval> place, double value) {
    place[0] = Interval(value);
    return place;
  }

  /// Encloses the one solution at a place in a small box near some values.
  std::optional<std::vector<Interval>> solution_at(std::span<const Interval> near,
                                                   const std::vector<Interval>& place) {
    BranchPoint point;
    for (const Interval& x : place) point.variables.push_back(mid(x));
    for (const Interval& p : near) point.unknowns.push_back(mid(p));
    const auto settled = settle(system_, question_.shape, {&point, 1});
    if (!settled[0]) return std::nullopt;
    const TubeTrial trial = trial_at(*settled[0], place);
    TubeFinding found;
    finder_.find({&trial, 1}, {&found, 1});
    return found.tube ? std::optional(enclose(*found.tube, place)) : std::nullopt;
  }

  /// The leaves at the joint in whose middle the branch arrives; join() shows that it does.
  bool go_on() {
    std::vector<Interval> place;
    for (std::size_t k = 0; k < question_.shape.variables; ++k)
      place.emplace_back(mid(question_.problem.outer[k]));
    start_leaves_ = tree_.leaves_at(with_first(std::move(place), before_->begin));
    const bool have_tubes =
        !start_leaves_.empty() && std::ranges::all_of(start_leaves_, [this](std::size_t leaf) {
          return tree_.leaves()[leaf].tube.has_value();
        });
    if (!have_tubes)
      links_.obstacle = "the begin of the segment is not within boxes with a tube";
    else
      start_leaves_.resize(1);
    return have_tubes;
  }

  /// Boxes of both pieces that share a face at the joint hold one solution at its middle.
  void join(const MustStop& must_stop) {
    std::size_t joints = 0;
    bool are_joined = true;
    before_->tree.for_neighbours_after(
        tree_, question_.problem.outer,
        [&](std::size_t a, std::size_t b, const std::vector<Interval>& face) {
          if (!are_joined || must_stop()) return;
          std::vector<Interval> place;
          for (std::size_t k = 0; k < question_.shape.variables; ++k)
            place.emplace_back(mid(face[k]));
          const std::vector<Interval> begin = with_first(place, before_->begin),
                                      end = with_first(place, before_->end);
          const auto solution = solution_at(enclose(tube(b), begin), begin);
          are_joined = solution && certain_holds(tube(b), begin, *solution) &&
                       certain_holds(*before_->tree.leaves()[a].tube, end, *solution);
          ++joints;
          if (links_.configuration.empty() && solution) links_.configuration = *solution;
        });
    links_.links += joints;
    const auto reason = must_stop();
    if (!reason && are_joined && joints > 0) return;
    links_.is_one_branch = false;
    std::ranges::fill(links_.on_branch, 0);
    if (reason)
      links_.obstacle = describe(*reason);
    else if (links_.obstacle.empty())
      links_.obstacle = "the branch is not shown to go on from the segment before";
  }

  /// The box of the start has one solution, which a leaf holds.
  bool begin() {
    const std::vector<Interval>& place = start_->place;
    links_.obstacle = obstacle_of_start(system_, question_.shape, *start_);
    if (!links_.obstacle.empty()) return false;
    const std::vector<std::size_t> leaves = tree_.leaves_at(start_->place);
    std::size_t of_start = 0;
    for (const std::size_t leaf : leaves) {
      if (!tree_.leaves()[leaf].tube) {
        links_.obstacle = "the start is not within boxes that have a tube";
        return false;
      }
      meetings_.push_back({leaf, BranchTree::kNone, place, false, false});
      meet({&(of_start = meetings_.size() - 1), 1});
      if (!meetings_.back().is_linked) {
        links_.obstacle = "the box at the start holds another configuration";
        return false;
      }
    }
    start_leaves_ = leaves;
    return true;
  }

  void meet(std::span<const std::size_t> meetings, const MustStop& must_stop) {
    for (std::size_t at = 0; at < meetings.size() && !must_stop(); at += kLanes)
      meet(meetings.subspan(at, std::min(kLanes, meetings.size() - at)));
  }

  [[nodiscard]] BranchPoint near(const Meeting& meeting) const {
    BranchPoint point;
    for (const Interval& x : meeting.place) point.variables.push_back(mid(x));
    for (const Interval& p : enclose(tube(meeting.a), meeting.place))
      point.unknowns.push_back(mid(p));
    return point;
  }

  static TubeTrial trial_at(const TrackedPoint& point, std::vector<Interval> box) {
    return {
        std::move(box), {point.at.variables, point.at.unknowns, point.slopes, {}}, point.inverse};
  }

  /// Encloses the solution at each of 1…8 places in a small box, and looks if both hold it.
  void meet(std::span<const std::size_t> meetings) {
    std::vector<BranchPoint> points;
    for (const std::size_t i : meetings) points.push_back(near(meetings_[i]));
    const auto settled = settle(system_, question_.shape, points);
    std::vector<TubeTrial> trials;
    std::vector<std::size_t> of;
    for (std::size_t i = 0; i < settled.size(); ++i) {
      meetings_[meetings[i]].is_linked = false;
      if (!settled[i]) continue;
      trials.push_back(trial_at(*settled[i], meetings_[meetings[i]].place));
      of.push_back(meetings[i]);
    }
    if (trials.empty()) return;
    std::vector<TubeFinding> found(trials.size());
    finder_.find(trials, found);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!found[i].tube) continue;
      Meeting& meeting = meetings_[of[i]];
      const std::vector<Interval> solution = enclose(*found[i].tube, meeting.place);
      meeting.is_linked = is_held_by_both(meeting, solution);
      if (meeting.is_linked && meeting.b == BranchTree::kNone) links_.configuration = solution;
    }
  }

  /// Replaces tubes of another branch that have a neighbour on this one, from where it is.
  void mend(const MustStop& must_stop) {
    for (bool has_changed = true; has_changed && !must_stop();) {
      has_changed = false;
      const std::vector<char> on_branch = joined({});
      for (Meeting& meeting : meetings_) {
        if (meeting.is_linked || meeting.was_mended || meeting.b == BranchTree::kNone) continue;
        if (on_branch[meeting.a] == on_branch[meeting.b]) continue;
        meeting.was_mended = true;
        const bool is_a_good = on_branch[meeting.a] != 0;
        if (!mend(is_a_good ? meeting.a : meeting.b, is_a_good ? meeting.b : meeting.a, meeting))
          continue;
        has_changed = true;
        break;
      }
    }
  }

  bool mend(std::size_t good, std::size_t bad, const Meeting& meeting) {
    const BranchPoint from = near({good, bad, meeting.place, false, false});
    const std::vector<double> middle = tube(bad).at;
    const auto tracked = track(system_, question_.shape, from, {&middle, 1});
    if (!tracked[0]) return false;
    const std::vector<Interval>& box = tree_.leaves()[bad].at.box;
    const TubeTrial trial = trial_at(
        *tracked[0], {box.begin(), box.begin() + std::ptrdiff_t(question_.shape.variables)});
    TubeFinding found;
    finder_.find({&trial, 1}, {&found, 1});
    if (!found.tube) return false;
    tree_.replace(bad, *found.tube);
    std::vector<std::size_t> changed;
    for (std::size_t i = 0; i < meetings_.size(); ++i)
      if (meetings_[i].a == bad || meetings_[i].b == bad) changed.push_back(i);
    meet(changed, [] { return std::nullopt; });
    return true;
  }

  /// Returns the leaves that links join with the start, without those that are left out.
  [[nodiscard]] std::vector<char> joined(const std::vector<char>& is_left_out) const {
    const std::size_t count = tree_.leaves().size();
    const auto is_out = [&](std::size_t leaf) {
      return !is_left_out.empty() && is_left_out[leaf] != 0;
    };
    Groups groups(count);
    for (const Meeting& m : meetings_)
      if (m.is_linked && m.b != BranchTree::kNone && !is_out(m.a) && !is_out(m.b))
        groups.join(m.a, m.b);
    for (const std::size_t start : start_leaves_) groups.join(start, start_leaves_.front());
    std::vector<char> result(count, 0);
    for (std::size_t leaf = 0; leaf < count; ++leaf)
      result[leaf] = tree_.leaves()[leaf].tube && !is_out(leaf) &&
                     groups.of(leaf) == groups.of(start_leaves_.front());
    return result;
  }

  [[nodiscard]] bool is_held_by_both(const Meeting& meeting,
                                     const std::vector<Interval>& solution) const {
    if (!certain_holds(tube(meeting.a), meeting.place, solution)) return false;
    if (meeting.b != BranchTree::kNone)
      return certain_holds(tube(meeting.b), meeting.place, solution);
    for (std::size_t i = 0; i < solution.size(); ++i)
      if (!(mag(solution[i] - start_->values[i]) <= start_->radius[i].lo)) return false;
    return true;
  }

  /// Leaves out neighbours on the branch that are not linked, until there are none.
  void conclude() {
    const std::size_t count = tree_.leaves().size();
    std::vector<char> is_left_out(count, 0);
    bool is_torn = false;
    for (bool has_changed = true; has_changed;) {
      has_changed = false;
      links_.on_branch = joined(is_left_out);
      for (const Meeting& m : meetings_) {
        if (m.is_linked || m.b == BranchTree::kNone) continue;
        is_torn = true;
        if (links_.on_branch[m.a] != 0 && links_.on_branch[m.b] != 0)
          is_left_out[m.a] = is_left_out[m.b] = 1, has_changed = true;
      }
    }
    links_.links = std::size_t(std::ranges::count_if(meetings_, &Meeting::is_linked));
    links_.is_one_branch = true;
    for (std::size_t leaf = 0; leaf < count; ++leaf)
      if (tree_.leaves()[leaf].tube && links_.on_branch[leaf] == 0) links_.is_one_branch = false;
    if (links_.is_one_branch) return;
    links_.obstacle = is_torn
                          ? "two neighbouring boxes are not shown to hold one configuration"
                          : "constraints cut the motion in parts, and the start is in one of them";
  }

  const ClosureQuestion& question_;
  BranchTree& tree_;
  const BranchStart* const start_;
  const BranchBefore* const before_;
  SystemBoxes system_;
  TubeFinder finder_;
  std::vector<Meeting> meetings_;
  std::vector<std::size_t> start_leaves_;
  BranchLinks links_;
};

}  // namespace

BranchLinks link_branch(const ClosureQuestion& question, BranchTree& tree, const BranchStart& start,
                        const MustStop& must_stop) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  return Linker(question, tree, &start, nullptr).link(must_stop);
}

BranchLinks link_branch(const ClosureQuestion& question, BranchTree& tree,
                        const BranchBefore& before, const MustStop& must_stop) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  return Linker(question, tree, nullptr, &before).link(must_stop);
}

std::optional<std::vector<Interval>> configuration_after(const ClosureQuestion& question,
                                                         const BranchBefore& before) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  BranchTree none;
  return Linker(question, none, nullptr, &before).configuration_of_before();
}

}  // namespace regulus::detail
