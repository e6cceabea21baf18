// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/followed_solutions.hpp"

#include <algorithm>
#include <cmath>

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
  SolutionFollowing(const Problem& problem, const PreparedSystem& prepared,
                    const std::vector<Interval>& periods, RootSettings settings, Observer* progress)
      : problem_(problem),
        prepared_(prepared),
        periods_(periods),
        settings_(std::move(settings)),
        progress_(progress),
        ranges_(problem.outer.begin() + std::ptrdiff_t(prepared.shape.variables),
                problem.outer.begin() +
                    std::ptrdiff_t(prepared.shape.variables + prepared.shape.unknowns)) {}

  SolutionTubes follow(const std::vector<Unknowns>& solutions) {
    result_.open =
        search_in_levels(ranges_, settings_, [this](const Unknowns& box) { return search(box); });
    result_.open.insert(result_.open.end(), at_ends_.begin(), at_ends_.end());
    const Turning turning(periods_);
    const auto may_touch = [&](const Unknowns& a, const Unknowns& b) {
      return turning.may_touch(a, b);
    };
    const auto hull_of = [&](const Unknowns& a, const Unknowns& b) {
      return turning.hull_of(a, b);
    };
    for (const Unknowns& solution : solutions)
      result_.tubes.push_back(result_.stopped_by
                                  ? std::nullopt
                                  : reach_from(solution, boxes_, result_.open, may_touch, hull_of));
    result_.are_all = result_.open.empty() && !result_.stopped_by;
    return std::move(result_);
  }

 private:
  /// Returns what is not decided.
  std::vector<Unknowns> search(const Unknowns& box) {
    if (result_.stopped_by) return {box};
    Problem problem = problem_;
    std::ranges::copy(box, problem.outer.begin() + std::ptrdiff_t(prepared_.shape.variables));
    std::ranges::copy(box, problem.inner.begin() + std::ptrdiff_t(prepared_.shape.variables));
    RootList found =
        search_roots(question_of_followed(problem, prepared_), periods_, settings_, progress_);
    for (Unknowns& part : found.regular)
      (is_inside(part) ? boxes_ : at_ends_).push_back(std::move(part));
    result_.stopped_by = found.stopped_by;
    result_.boxes += found.boxes;
    result_.seconds += found.seconds;
    settings_.max_boxes -= std::min(settings_.max_boxes, found.boxes);
    settings_.time_limit -= found.seconds;
    return std::move(found.open);
  }

  /// False if a solution in the box may leave the ranges.
  [[nodiscard]] bool is_inside(const Unknowns& box) const {
    for (std::size_t i = 0; i < box.size(); ++i)
      if (periods_[i] == Interval(0.0) && !(ranges_[i].lo < box[i].lo && box[i].hi < ranges_[i].hi))
        return false;
    return true;
  }

  const Problem& problem_;
  const PreparedSystem& prepared_;
  const std::vector<Interval>& periods_;
  RootSettings settings_;
  Observer* const progress_;
  const Unknowns ranges_;
  /// With the open ones they hold all solutions, and the derivatives are regular all over them.
  std::vector<Unknowns> boxes_;
  std::vector<Unknowns> at_ends_;  ///< the same, at an end of the ranges
  SolutionTubes result_;
};

}  // namespace

Problem at_middles(Problem problem, const ClosedShape& shape) {
  for (std::size_t k = 0; k < shape.variables; ++k)
    problem.outer[k] = problem.inner[k].emplace(mid(problem.outer[k]));
  return problem;
}

SolutionTubes follow_solutions(const Problem& problem, const PreparedSystem& prepared,
                               const std::vector<Interval>& periods,
                               const std::vector<std::vector<Interval>>& solutions,
                               RootSettings settings, Observer* progress) {
  return SolutionFollowing(problem, prepared, periods, std::move(settings), progress)
      .follow(solutions);
}

}  // namespace regulus::detail
