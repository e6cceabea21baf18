// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/arm_following.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail {
namespace {

constexpr double kOverlapOfTurn = 0x1p-8;  ///< of the search over a turn, in radians

using Unknowns = std::vector<Interval>;

/// Encloses postures of which the searched unknowns of a system are in boxes.
class WholePostures {
 public:
  WholePostures(const ArmAtPlace& arm, std::size_t number)
      : arm_(arm),
        number_(number),
        divided_(divided_unknowns(arm, number)),
        judge_(systems_of_arm(arm, kWholeArm).question(problem_)) {}

  /// Returns the hull of those in the boxes with one of them; nullopt: an unknown does not follow all over a box.
  [[nodiscard]] std::optional<Unknowns> hull_with(Unknowns tube,
                                                  const std::vector<Unknowns>& parts) {
    const Unknowns near = tube;
    for (const Unknowns& part : parts) {
      const auto box = box_with(part, near);
      if (!box) return std::nullopt;
      RootFinding finding;
      judge_.judge({&*box, 1}, {&finding, 1}, 0);
      if (finding.is_empty) continue;
      for (std::size_t k = 0; k < tube.size(); ++k) tube[k] = hull(tube[k], finding.unknowns[k]);
    }
    return tube;
  }

 private:
  /// Adds the unknowns that follow; all are as near to a posture as whole turns allow.
  [[nodiscard]] std::optional<Unknowns> box_with(const Unknowns& searched,
                                                 const Unknowns& near) const {
    const auto following = enclose_following(arm_, number_, searched);
    if (!following) return std::nullopt;
    Unknowns box(near.size());
    for (std::size_t i = 0; i < searched.size(); ++i) box[divided_.searched[i]] = searched[i];
    for (std::size_t i = 0; i < following->size(); ++i)
      box[divided_.following[i]] = (*following)[i];
    const Interval turn = Interval(2.0) * kPi;
    for (std::size_t k = 0; k < box.size(); ++k)
      if (arm_.unknowns[k].is_periodic)
        box[k] += Interval(std::round((mid(near[k]) - mid(box[k])) / mid(turn))) * turn;
    return box;
  }

  const ArmAtPlace& arm_;
  const std::size_t number_;
  const DividedUnknowns divided_;
  const Problem problem_{};
  RootJudge judge_;
};

}  // namespace

FollowedRanges ranges_of_arm(const ArmAtPlace& arm, const std::map<std::size_t, SlideRange>& slides,
                             std::span<const std::size_t> unknowns) {
  const Interval circle(-mid(kPi) - kOverlapOfTurn, mid(kPi) + kOverlapOfTurn);
  FollowedRanges ranges;
  for (const std::size_t k : unknowns) {
    const bool is_periodic = arm.unknowns[k].is_periodic;
    ranges.searched.push_back(is_periodic ? circle : slides.at(k).range);
    ranges.periods.push_back(is_periodic ? Interval(2.0) * kPi : Interval(0.0));
    ranges.may_leave.push_back(!is_periodic);
  }
  return ranges;
}

std::vector<Interval> box_of_all(const ArmAtPlace& arm, std::size_t number,
                                 const std::map<std::size_t, SlideRange>& slides,
                                 const std::vector<Interval>& searched) {
  if (number == kWholeArm) return searched;
  std::vector<Interval> all(arm.unknowns.size(), Interval(-kPi.hi, kPi.hi));
  for (const auto& [k, slide] : slides) all[k] = slide.range;
  const DividedUnknowns divided = divided_unknowns(arm, number);
  for (std::size_t i = 0; i < searched.size(); ++i) all[divided.searched[i]] = searched[i];
  return all;
}

SolutionTubes follow_postures(const ArmAtPlace& arm, std::size_t number,
                              const std::map<std::size_t, SlideRange>& slides,
                              const std::vector<std::vector<Interval>>& postures,
                              RootSettings settings, Observer* progress) {
  const bool is_whole = number == kWholeArm;
  DividedUnknowns divided;
  if (!is_whole) divided = divided_unknowns(arm, number);
  for (std::size_t k = 0; is_whole && k < arm.unknowns.size(); ++k) divided.searched.push_back(k);
  const FollowedRanges ranges = ranges_of_arm(arm, slides, divided.searched);
  const RootSystems systems = followed_systems_of_arm(arm, number);
  const auto search = [&](const Unknowns& box, const RootSettings& own) {
    Problem problem;
    problem.outer = box;
    return search_roots(systems.question(problem), ranges.periods, own, progress);
  };
  std::vector<Unknowns> some;
  for (const Unknowns& posture : postures) {
    Unknowns& searched = some.emplace_back();
    for (const std::size_t k : divided.searched) searched.push_back(posture[k]);
  }
  SolutionTubes tubes = follow_in_ranges(ranges, search, some, std::move(settings));
  for (Unknowns& box : tubes.open) box = box_of_all(arm, number, slides, box);
  if (is_whole) return tubes;
  WholePostures whole(arm, number);
  for (std::size_t i = 0; i < postures.size(); ++i) {
    if (!tubes.tubes[i]) continue;
    tubes.tubes[i] = whole.hull_with(postures[i], tubes.parts[i]);
    tubes.are_all = tubes.are_all && tubes.tubes[i];
  }
  return tubes;
}

}  // namespace regulus::detail
