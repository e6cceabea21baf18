// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/singular_descent.hpp"

#include <algorithm>
#include <cmath>

#include "codegen/question/engine/point_values.hpp"
#include "codegen/support/decomposition.hpp"

namespace regulus::detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int kSamples = 16;
constexpr int kSteps = 40;
constexpr int kHalvings = 8;
constexpr std::size_t kEvaluations = 4000;
/// The most operations with 256 bits for all evaluations, of the order of a second: a report must
/// not take longer than the limit of the search.
constexpr std::size_t kMostOperations = 10'000'000;
/// Part of the range of a variable, for a difference quotient.
constexpr double kDifference = 1e-6;
/// If a step gains less, it is the last.
constexpr double kWorthAnotherStep = 0.999;

Interval within(const Interval& range, double x) noexcept {
  return Interval(std::clamp(x, range.lo, range.hi));
}

}  // namespace

ApproxMatrix approx_matrix(const Formulation& f, const Program& entries) {
  return {std::size_t(f.rows), std::size_t(f.columns), entries.nodes.size(),
          [&entries](std::span<const Interval> point) { return approx_values(entries, point); }};
}

SingularDescent::SingularDescent(const PreparedSearch& p, const ApproxMatrix& matrix)
    : matrix_(matrix),
      constraints_(lower_outputs(p.stages->natural_formulation(),
                                 p.stages->natural_formulation().constraints)),
      most_evaluations_(std::min(
          kEvaluations, kMostOperations / (1 + matrix.operations + constraints_.nodes.size()))) {
  for (std::size_t k = 0; k < p.variety.outer.size(); ++k)
    ranges_.push_back(p.variety.inner[k].value_or(Interval(mid(p.variety.outer[k]))));
  all_ranges_ = ranges_;
  scales_ = balance(typical_matrix(), matrix_.rows, matrix_.columns);
}

std::vector<Interval> SingularDescent::start(int number) {
  std::vector<Interval> point;
  for (const Interval& range : ranges_) {
    const double part = number == 0 ? 0.5 : double(random_()) / double(random_.max());
    point.push_back(within(range, range.lo + part * (range.hi - range.lo)));
  }
  return point;
}

std::vector<Interval> SingularDescent::middle_of(std::span<const Interval> box) const {
  std::vector<Interval> point;
  for (std::size_t k = 0; k < ranges_.size(); ++k) point.push_back(within(ranges_[k], mid(box[k])));
  return point;
}

std::optional<SingularDescent::Place> SingularDescent::from(const std::vector<Interval>& start) {
  std::optional<Place> place = look_at(start);
  for (int step = 0; place && step < kSteps && place->singular_value > 0; ++step) {
    std::optional<Place> better = improved(*place);
    if (!better) break;
    const bool last = better->singular_value > kWorthAnotherStep * place->singular_value;
    place = std::move(better);
    if (last) break;
  }
  return place;
}

/// Returns nullopt outside the constraints and if J⁻¹ has no value.
std::optional<SingularDescent::Place> SingularDescent::look_at(const std::vector<Interval>& point) {
  ++evaluations_;
  const auto constraints = approx_values(constraints_, point);
  if (!constraints ||
      std::any_of(constraints->begin(), constraints->end(), [](double h) { return h > 0; }))
    return std::nullopt;
  auto matrix = matrix_.at(point);
  if (!matrix) return std::nullopt;
  const double sigma = singular_values(scaled(*matrix)).minCoeff();
  return Place{point, std::move(*matrix), sigma};
}

/// Returns the means of the entries' magnitudes over a part of the variety. They distinguish
/// entries that are always small from entries that vanish somewhere.
std::vector<double> SingularDescent::typical_matrix() {
  std::vector<double> sum(matrix_.rows * matrix_.columns);
  for (int number = 0; number < kSamples; ++number)
    if (const auto matrix = matrix_.at(start(number)))
      for (std::size_t e = 0; e < sum.size(); ++e) sum[e] += std::fabs((*matrix)[e]) / kSamples;
  return sum;
}

MatrixXd SingularDescent::scaled(const std::vector<double>& matrix) const {
  const RowMajor A =
      Eigen::Map<const RowMajor>(matrix.data(), Index(matrix_.rows), Index(matrix_.columns));
  return scales_.row_scale.asDiagonal() * A * scales_.column_scale.asDiagonal();
}

/// Tries the step, and then shorter ones.
std::optional<SingularDescent::Place> SingularDescent::improved(const Place& place) {
  const VectorXd step = newton_step(place);
  double part = 1;
  for (int i = 0; i < kHalvings && !exhausted(); ++i, part /= 2) {
    std::vector<Interval> point = place.point;
    for (std::size_t k = 0; k < point.size(); ++k)
      point[k] = within(ranges_[k], point[k].lo + part * step(Index(k)));
    std::optional<Place> next = look_at(point);
    if (next && next->singular_value < place.singular_value) return next;
  }
  return std::nullopt;
}

/// Newton's step of least norm, relative to the ranges, towards A(x)·v = 0 with |v| = 1, from the
/// singular vector of the least singular value.
VectorXd SingularDescent::newton_step(const Place& place) {
  const MatrixXd A = scaled(place.matrix);
  const VectorXd v = decompose(A).v.rightCols<1>();
  const Index m = A.rows(), n = A.cols(), d = Index(place.point.size());
  MatrixXd system = MatrixXd::Zero(m + 1, d + n);
  for (Index k = 0; k < d; ++k) system.col(k).head(m) = slope(place, A, v, std::size_t(k));
  system.block(0, d, m, n) = A;
  system.block(m, d, 1, n) = v.transpose();
  VectorXd aim = VectorXd::Zero(m + 1);
  aim.head(m) = -(A * v);
  VectorXd step = solve_least_squares(system, aim).head(d);
  for (Index k = 0; k < d; ++k) step(k) *= width(std::size_t(k));
  return step;
}

/// Returns the change of A·v per width of variable k; zero if it is not known.
VectorXd SingularDescent::slope(const Place& place, const MatrixXd& A, const VectorXd& v,
                                std::size_t k) {
  const double x = place.point[k].lo;
  const double up = within(ranges_[k], x + kDifference * width(k)).lo;
  const double other = up > x ? up : within(ranges_[k], x - kDifference * width(k)).lo;
  if (other == x || exhausted()) return VectorXd::Zero(A.rows());
  ++evaluations_;
  std::vector<Interval> point = place.point;
  point[k] = Interval(other);
  const auto matrix = matrix_.at(point);
  if (!matrix) return VectorXd::Zero(A.rows());
  return (scaled(*matrix) - A) * v * (width(k) / (other - x));
}

}  // namespace regulus::detail
