// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/followed_solutions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/question/condition/singular_vectors.hpp"

namespace regulus::detail {
namespace {

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
  const auto first = std::ptrdiff_t(prepared.shape.variables);
  const auto end = first + std::ptrdiff_t(prepared.shape.unknowns);
  FollowedRanges ranges{{problem.outer.begin() + first, problem.outer.begin() + end}, periods, {}};
  for (const Interval& period : periods) ranges.may_leave.push_back(period == Interval(0.0));
  const auto search = [&](const std::vector<Interval>& box, const RootSettings& own) {
    Problem part = problem;
    std::ranges::copy(box, part.outer.begin() + first);
    std::ranges::copy(box, part.inner.begin() + first);
    return search_roots(question_of_followed(part, prepared), periods, own, progress);
  };
  return follow_in_ranges(ranges, search, solutions, std::move(settings));
}

}  // namespace regulus::detail
