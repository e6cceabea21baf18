// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/singular_values.hpp"

#include <algorithm>
#include <cmath>

#include "codegen/question/condition/condition_test.hpp"
#include "codegen/question/condition/rotated_boxes.hpp"
#include "codegen/question/condition/singular_value_test.hpp"
#include "codegen/question/condition/stretched_vectors.hpp"

namespace regulus::detail {
namespace {

bool are_finite(const std::vector<double>& numbers) {
  return std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
}

/// The part of the change to first order that counts as excess: where the place of the largest value is
/// not in the motion, only smaller boxes tell more.
constexpr double kPartOfGrowth = 0.125;

/// Gives what the tube's radius adds to the variables that make it so wide.
std::vector<double> by_variable(std::vector<double> impact, const BranchTube& tube,
                                const TubeImage& image) {
  const std::size_t m = tube.at.size(), n = tube.radius.size();
  if (impact.size() != m + n) return {};
  for (std::size_t l = 0; l < n; ++l)
    for (std::size_t k = 0; k < m; ++k)
      impact[k] += impact[m + l] * image.impact[l * m + k] / tube.radius[l];
  impact.resize(m);
  return are_finite(impact) ? impact : std::vector<double>{};
}

}  // namespace

bool SingularValues::are_of(QuantityKind kind) {
  return kind == QuantityKind::kCondition2 || kind == QuantityKind::kSigmaMax ||
         kind == QuantityKind::kSigmaMin;
}

std::vector<Interval> SingularValues::scaled(std::span<const Interval> by_unknown) const {
  std::vector<Interval> result;
  for (std::size_t e = 0; e < by_unknown.size(); ++e)
    result.push_back(by_unknown[e] * factors_[e % factors_.size()]);
  return result;
}

BoxMatrix SingularValues::matrix_over(const TubeTrial& trial,
                                      const TubeFinder::Measured& measured) const {
  const BranchTube& tube = trial.tube;
  const std::size_t m = tube.at.size(), n = tube.radius.size(), size = n * n;
  const std::span<const Interval> rates(measured.over.rates_by_unknown);
  const auto rate = [&](std::size_t by) { return scaled(rates.subspan(by * size, size)); };
  BoxMatrix A;
  A.center = scaled(measured.center_by_unknown);
  std::vector<std::vector<Interval>> by_unknown;
  for (std::size_t l = 0; l < n; ++l) by_unknown.push_back(rate(m + l));
  for (std::size_t k = 0; k < m; ++k) {
    std::vector<Interval> slope = rate(k);
    for (std::size_t l = 0; l < n; ++l)
      for (std::size_t e = 0; e < size; ++e)
        slope[e] += Interval(tube.slopes[l * m + k]) * by_unknown[l][e];
    A.slopes.insert(A.slopes.end(), slope.begin(), slope.end());
    A.radius.push_back(mag(trial.box[k] - Interval(tube.at[k])));
  }
  for (std::size_t l = 0; l < n; ++l) {
    A.slopes.insert(A.slopes.end(), by_unknown[l].begin(), by_unknown[l].end());
    A.radius.push_back(tube.radius[l]);
  }
  return A;
}

SingularValueFinding SingularValues::bound(const TubeTrial& trial,
                                           const TubeFinder::Measured& measured) const {
  const std::size_t m = trial.tube.at.size(), n = trial.tube.radius.size();
  const auto rotated = rotate(matrix_over(trial, measured), n, n);
  if (!rotated) return {};
  SingularValueFinding result;
  std::vector<double> impact;
  if (kind_ == QuantityKind::kCondition2) {
    ConditionBound bound = bound_condition(*rotated);
    result.upper = bound.upper;
    result.growth = std::move(bound.growth), impact = std::move(bound.impact);
  } else {
    const bool is_largest = kind_ == QuantityKind::kSigmaMax;
    SingularValueBound bound =
        bound_singular_value(*rotated, is_largest ? Extreme::kLargest : Extreme::kLeast);
    if (is_largest || bound.value > 0) result.upper = is_largest ? bound.value : -bound.value;
    result.growth = std::move(bound.growth), impact = std::move(bound.impact);
    for (double& slope : result.growth) slope = is_largest ? slope : -slope;
  }
  result.growth.resize(std::min(m, result.growth.size()));
  if (!are_finite(result.growth)) result.growth.clear();
  result.impact = by_variable(std::move(impact), trial.tube, measured.image);
  const double size = rotated->center.middle[kind_ == QuantityKind::kSigmaMin ? n * n - 1 : 0];
  for (std::size_t k = 0; k < std::min(result.impact.size(), result.growth.size()); ++k)
    result.impact[k] += kPartOfGrowth * std::fabs(result.growth[k] * size) * rotated->radius[k];
  return result;
}

double SingularValues::attained(const TubeFinder::Measured& measured) const {
  const std::vector<Interval> A = scaled(measured.over.by_unknown);
  const std::size_t n = factors_.size();
  double f = -kInfinity;
  if (kind_ == QuantityKind::kCondition2)
    f = attained_condition(A, n, n).condition;
  else if (kind_ == QuantityKind::kSigmaMax)
    f = attained_values(A, n, n).largest;
  else
    f = -attained_values(A, n, n).least;
  return f < kInfinity ? f : -kInfinity;
}

}  // namespace regulus::detail
