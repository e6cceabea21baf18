// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/analysis/least_singular.hpp"

#include "codegen/engine/point_values.hpp"
#include "codegen/engine/singular_descent.hpp"

namespace regulus::inline analysis {
namespace {

constexpr int kStarts = 16;

ApproxMatrix approx_matrix(const InverseJacobian& jacobian) {
  return {jacobian.rows(), jacobian.columns(), jacobian.operations(),
          [&jacobian](std::span<const Interval> point) { return jacobian.approx_at(point); }};
}

std::vector<Interval> approx_pose(const PreparedSearch& p, std::span<const Interval> point) {
  std::vector<Interval> pose;
  const auto values = approx_values(
      lower_outputs(p.stages->natural_formulation(), p.stages->natural_formulation().pose), point);
  if (values)
    for (const double x : *values) pose.emplace_back(x);
  return pose;
}

}  // namespace

std::optional<LeastSingular> approx_least_singular(const PreparedSearch& p,
                                                   std::span<const Interval> box) {
  const InverseJacobian jacobian(p);
  const ApproxMatrix matrix = approx_matrix(jacobian);
  SingularDescent descent(p, matrix);
  std::optional<SingularDescent::Place> best;
  for (int number = -1; number < kStarts && !descent.exhausted(); ++number) {
    if (number < 0 && box.empty()) continue;
    auto place = descent.from(number < 0 ? descent.middle_of(box) : descent.start(number));
    if (place && (!best || place->singular_value < best->singular_value)) best = std::move(place);
    if (best && best->singular_value <= kNegligible) break;
  }
  if (!best) return std::nullopt;
  const auto degeneracy = jacobian.approx_degeneracy(best->point);
  if (!degeneracy) return std::nullopt;
  return LeastSingular{best->point, approx_pose(p, best->point), *degeneracy};
}

std::optional<LeastSingular> nearest_singular(const PreparedSearch& preparation,
                                              const Result& result) {
  if (preparation.stopped || result.verdict != Verdict::kPossibleProblem ||
      result.reason == Reason::kUndefined || result.occupancy == Occupancy::kEmpty)
    return std::nullopt;
  return approx_least_singular(preparation, result.blocking_box);
}

}  // namespace regulus::analysis
