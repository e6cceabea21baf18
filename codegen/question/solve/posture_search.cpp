// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/posture_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "runtime/solutions/arm_postures.hpp"

namespace regulus::detail {
namespace {

/// Each way to choose opposite joints gets so many boxes at first, and then all that are left.
constexpr std::uint64_t kFirstBoxes = 3000;
/// After a box that cannot be split: each way then only looks for more postures that are certain.
constexpr std::uint64_t kBoxesAfterProblem = 4000;
/// If postures can be followed, boxes are not split below this part of their range.
constexpr double kWidthOfFollowed = 0x1p-7;
constexpr std::uint64_t kBoxesOfFollowed = 100;
/// E is no half turn if 3 less its trace is below this.
constexpr double kHalfTurn = 4;

}  // namespace

PostureSearch::PostureSearch(const ArmAtPlace& at, const std::map<std::size_t, SlideRange>& slides,
                             std::size_t number, RootSettings settings, Observer* progress)
    : at_(at),
      slides_(slides),
      number_(number),
      settings_(std::move(settings)),
      progress_(progress),
      systems_(systems_without_two(at)) {}

FoundPostures PostureSearch::find(PostureEffort effort) {
  settings_.boxes_after_problem = kBoxesAfterProblem;
  if (effort == PostureEffort::kFirst) {
    settings_.boxes_after_problem = kBoxesOfFollowed;
    settings_.min_relative_width = kWidthOfFollowed;
    settings_.max_boxes = std::min(settings_.max_boxes, kFirstBoxes);
  }
  FoundPostures found = systems_.empty()                  ? by_all_joints()
                        : effort == PostureEffort::kFirst ? by_opposite_axes(systems_.front())
                                                          : by_opposite_axes();
  found.boxes = boxes_;
  found.seconds = seconds_;
  return found;
}

/// The whole arm near a posture. Nothing of the question but its sizes is read.
RootJudge PostureSearch::judge_of_arm() const {
  const auto arm = [this] { return at_.equations(varies()); };
  return RootJudge({problem_, {0, 0, at_.unknowns.size(), 0}, arm});
}

/// 3 less the trace of E.
Interval PostureSearch::trace_gap(const Root& root) const {
  const auto arm = at_.equations(false);
  arm->evaluate(std::vector<RootSystem::Box>{root.values}, false);
  return arm->at(0)->also.front();
}

/// True if E at a solution of the equations is the unit matrix, and not a half turn.
bool PostureSearch::is_posture(const Root& root) const { return trace_gap(root).hi < kHalfTurn; }

/// All postures, if as many as the theorem allows are certain among complex numbers.
std::optional<FoundPostures> PostureSearch::by_counting() {
  if (varies() || at_.direction || !at_.is_plain() || !slides_.empty()) return std::nullopt;
  ArmToEnd arm;
  for (std::size_t k = 0; k < kJoints; ++k)
    arm.joints[k] = {{at_.chain[k].origin.R, at_.chain[k].origin.d}, at_.chain[k].axis};
  arm.end = {at_.target.R, at_.target.d};
  const ArmPostures counted = find_arm_postures(arm);
  if (!counted.is_complete()) return std::nullopt;
  FoundPostures found;
  for (const PostureAngles& angles : counted.postures) {
    std::vector<double> near;
    for (const Interval& angle : angles) near.push_back(mid(angle));
    auto root = judge_of_arm().root_near({}, near);
    if (!root || !is_posture(*root) || !root->is(angles)) return std::nullopt;
    found.postures.push_back(std::move(*root));
  }
  found.system = systems_.front();
  found.complex_found = counted.complex;
  return found;
}

FoundPostures PostureSearch::by_opposite_axes() {
  FoundPostures best;
  const std::uint64_t all = settings_.max_boxes;
  for (const std::uint64_t most : {std::min(all, kFirstBoxes), all}) {
    for (const std::size_t system : systems_) {
      settings_.max_boxes = most;
      FoundPostures found = by_opposite_axes(system);
      const bool is_last = found.obstacle.empty() || found.stopped_by == Reason::kInterrupted ||
                           found.stopped_by == Reason::kTimeBudget;
      if (system == systems_.front() || found.obstacle.empty() ||
          found.postures.size() > best.postures.size())
        best = std::move(found);
      if (is_last) return best;
    }
    if (auto counted = by_counting()) return std::move(*counted);
  }
  return best;
}

FoundPostures PostureSearch::by_opposite_axes(std::size_t system) {
  const RootSystems systems = systems_of_arm(at_, system);
  const auto searched = divided_unknowns(at_, system).searched;
  const FollowedRanges ranges = ranges_of_arm(at_, slides_, searched);
  const RootList list = search(systems, ranges);
  Problem problem;
  problem.outer = ranges.searched;
  RootJudge judge(systems.question(problem));
  FoundPostures found = found_by(system, list);
  for (const Root& four : list.roots)
    if (!add_posture(found, four, judge, systems)) {
      found.open.push_back(box_of_all(at_, system, slides_, four.values));
      found.obstacle = "a solution of four joints is not shown to be a posture, or none";
      found.may_meet = false;
    }
  return found;
}

/// Returns false if neither is shown.
bool PostureSearch::add_posture(FoundPostures& found, const Root& four, RootJudge& judge,
                                const RootSystems& systems) const {
  const auto system = systems.system();
  const std::vector<RootSystem::Box> boxes = {four.values};
  system->evaluate(boxes, false);
  if (!std::ranges::all_of(system->at(0)->also, contains_zero)) return true;  // the other hand
  const auto [searched, following] = divided_unknowns(at_, found.system);
  std::vector<double> near(at_.unknowns.size()), values;
  for (const Interval& value : four.values) values.push_back(mid(value));
  const auto others = approx_following(at_, found.system, values);
  for (std::size_t i = 0; i < searched.size(); ++i) near[searched[i]] = values[i];
  for (std::size_t i = 0; i < following.size(); ++i) near[following[i]] = others[i];
  auto root = varying_posture_near(at_, near);
  if (!root) root = judge_of_arm().root_near({}, near);
  if (!root || !is_posture(*root)) return false;
  // It is regular, so that no other values of the two joints fit the same four.
  const Interval turn = Interval(2.0) * kPi;
  std::vector<Interval> same;
  for (std::size_t i = 0; i < searched.size(); ++i) {
    const Interval& value = root->values[searched[i]];
    const double whole = at_.unknowns[searched[i]].is_periodic
                             ? std::round((four.center[i] - mid(value)) / mid(turn))
                             : 0;
    same.push_back(value + Interval(whole) * turn);
  }
  // The box of a root may be smaller than the enclosures: it is the only one much farther, too.
  const auto wide = four.is(same) ? std::nullopt : judge.root_near({}, four.center);
  if (!four.is(same) && !(wide && wide->is(four.values) && wide->is(same))) return false;
  found.postures.push_back(std::move(*root));
  return true;
}

FoundPostures PostureSearch::by_all_joints() {
  std::vector<std::size_t> all(at_.unknowns.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const RootList list = search(systems_of_arm(at_, kWholeArm), ranges_of_arm(at_, slides_, all));
  FoundPostures found = found_by(kWholeArm, list);
  for (const Root& root : list.roots) {
    if (is_posture(root)) {
      found.postures.push_back(root);
      continue;
    }
    if (!contains_zero(trace_gap(root))) continue;  // a half turn
    found.obstacle = "a solution is not told from a half turn";
    found.may_meet = false;
    found.open.push_back(root.values);
  }
  return found;
}

RootList PostureSearch::search(const RootSystems& systems, const FollowedRanges& ranges) {
  Problem problem;
  problem.outer = ranges.searched;
  RootQuestion question = systems.question(problem);
  question.number += number_;
  RootList list = search_roots(question, ranges.periods, settings_, progress_);
  boxes_ += list.boxes;
  seconds_ += list.seconds;
  settings_.time_limit -= list.seconds;
  return list;
}

/// Returns what the search leaves, without its roots.
FoundPostures PostureSearch::found_by(std::size_t system, const RootList& list) const {
  FoundPostures found;
  found.system = system;
  found.stopped_by = list.stopped_by;
  for (const std::vector<Interval>& box : list.open)
    found.open.push_back(box_of_all(at_, system, slides_, box));
  if (list.is_complete) return found;
  found.may_meet = !list.stopped_by;
  found.obstacle = list.stopped_by ? describe(*list.stopped_by)
                   : varies()      ? "within the tolerances postures may meet"
                                   : "several postures meet, or there are infinitely many";
  return found;
}

}  // namespace regulus::detail
