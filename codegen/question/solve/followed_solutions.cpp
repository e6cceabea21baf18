// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/followed_solutions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/question/condition/singular_vectors.hpp"
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

/// Returns a number of few digits near an end of the range, or the end if that is outside.
double short_number(double end, const Interval& range) {
  constexpr int kDigits = 9;
  const double near = std::stod(fmt::format("{:.{}g}", end, kDigits));
  return range.lo <= near && near <= range.hi ? near : end;
}

}  // namespace

Problem at_middles(Problem problem, const ClosedShape& shape) {
  for (std::size_t k = shape.parameters; k < shape.variables; ++k)
    problem.outer[k] = problem.inner[k].emplace(mid(problem.outer[k]));
  return problem;
}

Problem towards_singular(const Problem& problem, const PreparedSystem& prepared,
                         const std::vector<Interval>& solution) {
  const ClosedShape& shape = prepared.shape;
  const std::size_t n = shape.unknowns;
  std::vector<double> near(n);
  std::ranges::transform(solution, near.begin(), [](const Interval& x) { return mid(x); });
  const Problem middle = at_middles(problem, shape);
  const SystemBoxes::Box variables(middle.outer.begin(),
                                   middle.outer.begin() + std::ptrdiff_t(shape.variables));
  RootJudge judge(question_of_system(problem, prepared));
  SystemBoxes system(problem, prepared.scaling, shape);
  /// The least singular value of the derivatives where the solution is then; 0 if it is lost.
  const auto distance_at = [&](std::size_t k, double value) {
    SystemBoxes::Box point = variables;
    point[k] = Interval(value);
    const auto root = judge.root_near(point, near);
    if (!root) return 0.0;
    for (const Interval& x : root->values) point.emplace_back(mid(x));
    system.evaluate({&point, 1});
    const auto at = system.at(0);
    if (!at) return 0.0;
    std::vector<double> matrix;
    for (const Interval& entry : at->by_unknown) matrix.push_back(mid(entry));
    const auto vectors = approx_singular_vectors(matrix, n, n);
    return vectors ? vectors->values.back() : 0.0;
  };
  Problem corner = middle;
  const std::vector<VariableLabel>& labels = prepared.preparation.labels.variables;
  for (std::size_t k = shape.parameters; k < shape.variables; ++k) {
    const Interval& range = problem.outer[k];
    if (labels[k].in_ball || range.lo == range.hi) continue;
    const bool is_low = distance_at(k, range.lo) < distance_at(k, range.hi);
    corner.outer[k] = corner.inner[k].emplace(short_number(is_low ? range.lo : range.hi, range));
  }
  return corner;
}

SolutionTubes follow_solutions(const Problem& problem, const PreparedSystem& prepared,
                               const std::vector<Interval>& periods,
                               const std::vector<std::vector<Interval>>& solutions,
                               RootSettings settings, Observer* progress) {
  return SolutionFollowing(problem, prepared, periods, std::move(settings), progress)
      .follow(solutions);
}

}  // namespace regulus::detail
