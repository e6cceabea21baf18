// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/branch_links.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/interval/floating_point_scope.hpp"
#include "runtime/interval/lanes.hpp"

namespace regulus {
namespace {

/// A place at which two tubes, or a tube and the box of the start, must hold one solution.
struct Meeting {
  std::size_t a, b;             ///< leaves; b = kNone: the start
  std::vector<Interval> place;  ///< by variable
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
  Linker(const ClosureQuestion& question, const BranchTree& tree, const BranchStart& start)
      : question_(question),
        tree_(tree),
        start_(start),
        system_(question.problem, question.scaling, question.shape),
        finder_(system_, question.problem, question.shape) {}

  BranchLinks link(const std::atomic<bool>* interrupt) {
    links_.on_branch.assign(tree_.leaves().size(), 0);
    if (!begin()) return std::move(links_);
    const auto must_stop = [interrupt] { return interrupt != nullptr && *interrupt; };
    tree_.for_neighbours(question_.problem.outer,
                         [&](std::size_t a, std::size_t b, const std::vector<Interval>& face) {
                           if (must_stop()) return;
                           waiting_.push_back(meeting_of(a, b, face));
                           if (waiting_.size() == kLanes) meet();
                         });
    meet();
    if (must_stop())
      links_.obstacle = describe(Reason::kInterrupted);
    else
      conclude();
    return std::move(links_);
  }

 private:
  [[nodiscard]] const BranchTube& tube(std::size_t leaf) const {
    return *tree_.leaves()[leaf].tube;
  }

  /// The middle of the face; of uncertain quantities, too.
  Meeting meeting_of(std::size_t a, std::size_t b, const std::vector<Interval>& face) const {
    Meeting meeting{a, b, {}};
    for (std::size_t k = 0; k < question_.shape.variables; ++k)
      meeting.place.emplace_back(mid(face[k]));
    return meeting;
  }

  /// The box of the start has one solution, which a leaf holds.
  bool begin() {
    std::vector<Interval> place = start_.place;
    for (std::size_t k = place.size(); k < question_.shape.variables; ++k)
      place.emplace_back(question_.start.variables[k]);
    if (!has_one_start(place)) {
      links_.obstacle = "the values of 'start' are not shown to be near exactly one configuration";
      return false;
    }
    const std::vector<std::size_t> leaves = tree_.leaves_at(start_.place);
    for (const std::size_t leaf : leaves) {
      if (!tree_.leaves()[leaf].tube) {
        links_.obstacle = "the start is not within boxes that have a tube";
        return false;
      }
      waiting_.push_back({leaf, BranchTree::kNone, place});
      meet();
      if (links_.configuration.empty()) {
        links_.obstacle = "the box at the start holds another configuration";
        return false;
      }
    }
    start_leaves_ = leaves;
    return true;
  }

  bool has_one_start(const std::vector<Interval>& place) {
    BranchTube tube;
    for (const Interval& x : place) tube.at.push_back(mid(x));
    for (std::size_t i = 0; i < start_.values.size(); ++i) {
      const Interval& r = start_.radius[i];
      const Interval all = start_.values[i] + Interval(-r.hi, r.hi);
      tube.center.push_back(mid(all)), tube.radius.push_back(rad_ru(all));
    }
    tube.slopes.assign(tube.center.size() * tube.at.size(), 0.0);
    SystemBoxes::Box center, over;
    for (std::size_t k = 0; k < place.size(); ++k)
      center.emplace_back(tube.at[k]), over.push_back(hull(place[k], Interval(tube.at[k])));
    for (const double p : tube.center) center.emplace_back(p);
    const std::vector<Interval> unknowns = enclose(tube, over);
    over.insert(over.end(), unknowns.begin(), unknowns.end());
    const std::vector<SystemBoxes::Box> boxes{center, over};
    system_.evaluate(boxes);
    const auto at_center = system_.at(0), all = system_.at(1);
    if (!at_center || !all) return false;
    std::vector<double> matrix;
    for (const Interval& entry : at_center->by_unknown) matrix.push_back(mid(entry));
    const auto inverse = approx_inverse_of(matrix, tube.center.size());
    return inverse &&
           has_one_solution(tube, image_of(tube, place, *inverse,
                                           {at_center->value, all->by_unknown, all->by_variable}));
  }

  /// Encloses the solution at each place in a small box, and looks if both hold it.
  void meet() {
    std::vector<BranchPoint> near;
    for (const Meeting& meeting : waiting_) {
      BranchPoint& point = near.emplace_back();
      for (const Interval& x : meeting.place) point.variables.push_back(mid(x));
      for (const Interval& p : enclose(tube(meeting.a), meeting.place))
        point.unknowns.push_back(mid(p));
    }
    if (near.empty()) return;
    const auto settled = settle(system_, question_.shape, near);
    std::vector<TubeTrial> trials;
    std::vector<std::size_t> of;
    for (std::size_t i = 0; i < settled.size(); ++i) {
      if (!settled[i]) continue;
      trials.push_back({waiting_[i].place,
                        {settled[i]->at.variables, settled[i]->at.unknowns, settled[i]->slopes, {}},
                        settled[i]->inverse});
      of.push_back(i);
    }
    std::vector<TubeFinding> found(trials.size());
    if (!trials.empty()) finder_.find(trials, found);
    std::vector<char> is_linked(waiting_.size(), 0);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!found[i].tube) continue;
      const Meeting& meeting = waiting_[of[i]];
      const std::vector<Interval> solution = enclose(*found[i].tube, meeting.place);
      is_linked[of[i]] = is_held_by_both(meeting, solution) ? 1 : 0;
      if (is_linked[of[i]] != 0 && meeting.b == BranchTree::kNone) links_.configuration = solution;
    }
    for (std::size_t i = 0; i < waiting_.size(); ++i) note(waiting_[i], is_linked[i] != 0);
    waiting_.clear();
  }

  void note(const Meeting& meeting, bool is_linked) {
    if (is_linked) ++links_.links;
    if (meeting.b == BranchTree::kNone) return;
    (is_linked ? linked_ : torn_).emplace_back(meeting.a, meeting.b);
  }

  [[nodiscard]] bool is_held_by_both(const Meeting& meeting,
                                     const std::vector<Interval>& solution) const {
    if (!certain_holds(tube(meeting.a), meeting.place, solution)) return false;
    if (meeting.b != BranchTree::kNone)
      return certain_holds(tube(meeting.b), meeting.place, solution);
    for (std::size_t i = 0; i < solution.size(); ++i)
      if (!(mag(solution[i] - start_.values[i]) <= start_.radius[i].lo)) return false;
    return true;
  }

  /// Leaves out neighbours on the branch that are not linked, until there are none.
  void conclude() {
    const std::size_t count = tree_.leaves().size();
    std::vector<char> is_left_out(count, 0);
    for (bool has_changed = true; has_changed;) {
      has_changed = false;
      Groups groups(count);
      for (const auto& [a, b] : linked_)
        if (is_left_out[a] == 0 && is_left_out[b] == 0) groups.join(a, b);
      for (const std::size_t start : start_leaves_) groups.join(start, start_leaves_.front());
      for (std::size_t leaf = 0; leaf < count; ++leaf)
        links_.on_branch[leaf] = tree_.leaves()[leaf].tube && is_left_out[leaf] == 0 &&
                                 groups.of(leaf) == groups.of(start_leaves_.front());
      for (const auto& [a, b] : torn_)
        if (links_.on_branch[a] != 0 && links_.on_branch[b] != 0)
          is_left_out[a] = is_left_out[b] = 1, has_changed = true;
    }
    links_.is_one_branch = true;
    for (std::size_t leaf = 0; leaf < count; ++leaf)
      if (tree_.leaves()[leaf].tube && links_.on_branch[leaf] == 0) links_.is_one_branch = false;
    if (links_.is_one_branch) return;
    links_.obstacle = torn_.empty()
                          ? "constraints cut the motion in parts, and the start is in one of them"
                          : "two neighbouring boxes are not shown to hold one configuration";
  }

  const ClosureQuestion& question_;
  const BranchTree& tree_;
  const BranchStart& start_;
  SystemBoxes system_;
  TubeFinder finder_;
  std::vector<Meeting> waiting_;
  std::vector<std::pair<std::size_t, std::size_t>> linked_, torn_;
  std::vector<std::size_t> start_leaves_;
  BranchLinks links_;
};

}  // namespace

BranchLinks link_branch(const ClosureQuestion& question, const BranchTree& tree,
                        const BranchStart& start, const std::atomic<bool>* interrupt) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  return Linker(question, tree, start).link(interrupt);
}

}  // namespace regulus
