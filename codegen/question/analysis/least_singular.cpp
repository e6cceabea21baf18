// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/analysis/least_singular.hpp"

#include <cmath>

#include "codegen/question/engine/balanced_matrix.hpp"
#include "codegen/question/engine/point_values.hpp"
#include "codegen/question/engine/singular_descent.hpp"
#include "codegen/support/decomposition.hpp"

namespace regulus::detail {
namespace {

constexpr int kStarts = 16;
constexpr int kStartsAfterProof = 2;

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

/// Returns nullopt unless the matrix is square and defined at the point.
std::optional<double> approx_share(const InverseJacobian& jacobian,
                                   std::span<const Interval> point) {
  const std::size_t n = jacobian.rows();
  const auto entries = jacobian.approx_at(point);
  if (!entries || n != jacobian.columns()) return std::nullopt;
  const double share = std::fabs(determinant(balance(*entries, n, n).entries));
  return std::isfinite(share) ? std::optional(share) : std::nullopt;
}

std::optional<LeastSingular> least_singular(const PreparedSearch& p, std::span<const Interval> box,
                                            int starts) {
  const InverseJacobian jacobian(p);
  const ApproxMatrix matrix = approx_matrix(jacobian);
  SingularDescent descent(p, matrix);
  std::optional<SingularDescent::Place> best;
  for (int number = -1; number < starts && !descent.exhausted(); ++number) {
    if (number < 0 && box.empty()) continue;
    auto place = descent.from(number < 0 ? descent.middle_of(box) : descent.start(number));
    if (place && (!best || place->singular_value < best->singular_value)) best = std::move(place);
    if (best && best->singular_value <= kNegligible) break;
  }
  if (!best) return std::nullopt;
  const auto degeneracy = jacobian.approx_degeneracy(best->point);
  if (!degeneracy) return std::nullopt;
  return LeastSingular{best->point, approx_pose(p, best->point), *degeneracy,
                       approx_share(jacobian, best->point)};
}

}  // namespace

std::optional<LeastSingular> approx_least_singular(const PreparedSearch& p,
                                                   std::span<const Interval> box) {
  std::optional<LeastSingular> found = least_singular(p, box, kStarts);
  if (found) found->share.reset();
  return found;
}

namespace {

std::optional<LeastSingular> almost_singular(const PreparedSearch& p) {
  if (p.labels.rows != p.labels.columns) return std::nullopt;
  std::optional<LeastSingular> found = least_singular(p, {}, kStartsAfterProof);
  if (!found || !found->share || !(*found->share < kAlmostSingular)) return std::nullopt;
  return found;
}

}  // namespace

std::optional<LeastSingular> nearest_singular(const PreparedSearch& preparation,
                                              const Result& result) {
  if (preparation.stopped || result.verdict == Verdict::kSingularity ||
      result.reason == Reason::kUndefined || result.occupancy == Occupancy::kEmpty)
    return std::nullopt;
  if (result.verdict == Verdict::kNoSingularity) return almost_singular(preparation);
  return approx_least_singular(preparation, result.blocking_box);
}

}  // namespace regulus::detail
