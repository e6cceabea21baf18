// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/followed_tubes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "codegen/question/solve/followed_boxes.hpp"

namespace regulus::detail {
namespace {

using Unknowns = std::vector<Interval>;

/// Compares boxes of unknowns, of which some turn.
class Turning {
 public:
  explicit Turning(const std::vector<Interval>& periods) : periods_(periods) {}

  [[nodiscard]] bool may_touch(const Unknowns& a, const Unknowns& b) const {
    for (std::size_t i = 0; i < a.size(); ++i)
      if (!near(i, a[i], b[i])) return false;
    return true;
  }
  /// Requires  may_touch(a, b), or that a contains a box which may touch b.
  [[nodiscard]] Unknowns hull_of(const Unknowns& a, const Unknowns& b) const {
    Unknowns both;
    for (std::size_t i = 0; i < a.size(); ++i)
      both.push_back(hull(a[i], near(i, a[i], b[i]).value_or(b[i])));
    return both;
  }

 private:
  /// Returns b moved by whole turns so that it may touch a.
  [[nodiscard]] std::optional<Interval> near(std::size_t i, const Interval& a,
                                             const Interval& b) const {
    if (!certain_disjoint(a, b)) return b;
    if (periods_[i] == Interval(0.0)) return std::nullopt;
    const double turns = std::round((mid(a) - mid(b)) / mid(periods_[i]));
    for (const double more : {0.0, -1.0, 1.0}) {
      const Interval moved = b + Interval(turns + more) * periods_[i];
      if (!certain_disjoint(a, moved)) return moved;
    }
    return std::nullopt;
  }

  const std::vector<Interval>& periods_;
};

class SolutionFollowing {
 public:
  SolutionFollowing(const FollowedRanges& ranges, const SearchFollowed& search,
                    RootSettings settings)
      : ranges_(ranges), search_(search), settings_(std::move(settings)) {}

  SolutionTubes follow(const std::vector<Unknowns>& solutions) {
    result_.open = search_in_levels(ranges_.searched, settings_,
                                    [this](const Unknowns& box) { return search(box); });
    result_.open.insert(result_.open.end(), at_ends_.begin(), at_ends_.end());
    const Turning turning(ranges_.periods);
    const auto may_touch = [&](const Unknowns& a, const Unknowns& b) {
      return turning.may_touch(a, b);
    };
    const auto hull_of = [&](const Unknowns& a, const Unknowns& b) {
      return turning.hull_of(a, b);
    };
    result_.tubes.resize(solutions.size());
    result_.parts.resize(solutions.size());
    for (std::size_t i = 0; i < solutions.size() && !result_.stopped_by; ++i) {
      auto parts = reach_from(solutions[i], boxes_, result_.open, may_touch);
      if (!parts) continue;
      result_.tubes[i] = std::accumulate(parts->begin() + 1, parts->end(), parts->front(), hull_of);
      result_.parts[i] = std::move(*parts);
    }
    result_.are_all = result_.open.empty() && !result_.stopped_by;
    return std::move(result_);
  }

 private:
  /// Returns what is not decided.
  std::vector<Unknowns> search(const Unknowns& box) {
    if (result_.stopped_by) return {box};
    RootList found = search_(box, settings_);
    for (Unknowns& part : found.regular)
      (is_inside(part) ? boxes_ : at_ends_).push_back(std::move(part));
    result_.stopped_by = found.stopped_by;
    result_.boxes += found.boxes;
    result_.seconds += found.seconds;
    leave_rest(settings_, found);
    return std::move(found.open);
  }

  /// False if a solution in the box may leave the ranges.
  [[nodiscard]] bool is_inside(const Unknowns& box) const {
    for (std::size_t i = 0; i < box.size(); ++i)
      if (ranges_.may_leave[i] &&
          !(ranges_.searched[i].lo < box[i].lo && box[i].hi < ranges_.searched[i].hi))
        return false;
    return true;
  }

  const FollowedRanges& ranges_;
  const SearchFollowed& search_;
  RootSettings settings_;
  /// With the open ones they hold all solutions, and the derivatives are regular all over them.
  std::vector<Unknowns> boxes_;
  std::vector<Unknowns> at_ends_;  ///< the same, at an end of the ranges
  SolutionTubes result_;
};

}  // namespace

SolutionTubes follow_in_ranges(const FollowedRanges& ranges, const SearchFollowed& search,
                               const std::vector<std::vector<Interval>>& solutions,
                               RootSettings settings) {
  return SolutionFollowing(ranges, search, std::move(settings)).follow(solutions);
}

}  // namespace regulus::detail
