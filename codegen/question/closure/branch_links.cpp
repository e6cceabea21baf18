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
        finder_(system_, question.problem, question.shape),
        groups_(tree.leaves().size()) {}

  BranchLinks link(const std::atomic<bool>* interrupt) {
    if (!begin()) return std::move(links_);
    const std::vector<Interval>& root = question_.problem.outer;
    tree_.for_neighbours(root, [&](std::size_t a, std::size_t b, const auto& face) {
      if (!links_.obstacle.empty() || (interrupt != nullptr && *interrupt)) return;
      waiting_.push_back(meeting_of(a, b, face));
      if (waiting_.size() == kLanes) meet();
    });
    if (interrupt != nullptr && *interrupt) links_.obstacle = describe(Reason::kInterrupted);
    if (links_.obstacle.empty()) meet();
    if (links_.obstacle.empty()) conclude();
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
      if (!links_.obstacle.empty()) return false;
    }
    start_leaf_ = leaves.front();
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
    std::vector<const Meeting*> of;
    for (std::size_t i = 0; i < settled.size(); ++i) {
      if (!settled[i]) return fail(waiting_[i]);
      TubeTrial trial{waiting_[i].place,
                      {settled[i]->at.variables, settled[i]->at.unknowns, settled[i]->slopes, {}},
                      settled[i]->inverse};
      trials.push_back(std::move(trial));
      of.push_back(&waiting_[i]);
    }
    std::vector<TubeFinding> found(trials.size());
    finder_.find(trials, found);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!found[i].tube) return fail(*of[i]);
      const std::vector<Interval> solution = enclose(*found[i].tube, of[i]->place);
      if (!is_held_by_both(*of[i], solution)) return fail(*of[i]);
      ++links_.links;
      if (of[i]->b == BranchTree::kNone)
        links_.configuration = solution;
      else
        groups_.join(of[i]->a, of[i]->b);
    }
    waiting_.clear();
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

  void fail(const Meeting& meeting) {
    links_.obstacle = meeting.b == BranchTree::kNone
                          ? "the box at the start holds another configuration"
                          : "two neighbouring boxes are not shown to hold one configuration";
  }

  void conclude() {
    for (std::size_t leaf = 0; leaf < tree_.leaves().size(); ++leaf)
      if (tree_.leaves()[leaf].tube && groups_.of(leaf) != groups_.of(start_leaf_)) {
        links_.obstacle = "constraints cut the motion in parts, and the start is in one of them";
        return;
      }
    links_.is_one_branch = true;
  }

  const ClosureQuestion& question_;
  const BranchTree& tree_;
  const BranchStart& start_;
  SystemBoxes system_;
  TubeFinder finder_;
  Groups groups_;
  std::vector<Meeting> waiting_;
  std::size_t start_leaf_ = 0;
  BranchLinks links_;
};

}  // namespace

BranchLinks link_branch(const ClosureQuestion& question, const BranchTree& tree,
                        const BranchStart& start, const std::atomic<bool>* interrupt) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  return Linker(question, tree, start).link(interrupt);
}

}  // namespace regulus
