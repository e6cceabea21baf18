// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/analysis/least_singular.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <random>

#include "codegen/engine/balanced_matrix.hpp"
#include "codegen/engine/point_values.hpp"

namespace regulus::inline analysis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int kStarts = 16;
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

class Descent {
 public:
  explicit Descent(const PreparedSearch& p)
      : jacobian_(p),
        constraints_(lower_outputs(p.stages->natural_formulation(),
                                   p.stages->natural_formulation().constraints)),
        most_evaluations_(std::min(kEvaluations, kMostOperations / (1 + jacobian_.operations() +
                                                                    constraints_.nodes.size()))) {
    for (std::size_t k = 0; k < p.variety.outer.size(); ++k)
      ranges_.push_back(p.variety.inner[k].value_or(Interval(mid(p.variety.outer[k]))));
    scales_ = balance(typical_matrix(), jacobian_.rows(), jacobian_.columns());
  }

  struct Place {
    std::vector<Interval> point;
    std::vector<double> matrix;
    double singular_value;  ///< the least, of the scaled matrix
  };

  /// Returns the starting point of that number; number 0 is the middle of the variety.
  [[nodiscard]] std::vector<Interval> start(int number) {
    std::vector<Interval> point;
    for (const Interval& range : ranges_) {
      const double part = number == 0 ? 0.5 : double(random_()) / double(random_.max());
      point.push_back(within(range, range.lo + part * (range.hi - range.lo)));
    }
    return point;
  }
  [[nodiscard]] std::vector<Interval> middle_of(std::span<const Interval> box) const {
    std::vector<Interval> point;
    for (std::size_t k = 0; k < ranges_.size(); ++k)
      point.push_back(within(ranges_[k], mid(box[k])));
    return point;
  }

  [[nodiscard]] std::optional<Place> from(const std::vector<Interval>& start) {
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

  [[nodiscard]] bool exhausted() const noexcept { return evaluations_ >= most_evaluations_; }
  [[nodiscard]] const InverseJacobian& jacobian() const noexcept { return jacobian_; }

 private:
  static Interval within(const Interval& range, double x) noexcept {
    return Interval(std::clamp(x, range.lo, range.hi));
  }

  /// Returns nullopt outside the constraints and if J⁻¹ has no value.
  std::optional<Place> look_at(const std::vector<Interval>& point) {
    ++evaluations_;
    const auto constraints = approx_values(constraints_, point);
    if (!constraints ||
        std::any_of(constraints->begin(), constraints->end(), [](double h) { return h > 0; }))
      return std::nullopt;
    auto matrix = jacobian_.approx_at(point);
    if (!matrix) return std::nullopt;
    const double sigma = Eigen::JacobiSVD<MatrixXd>(scaled(*matrix)).singularValues().minCoeff();
    return Place{point, std::move(*matrix), sigma};
  }

  /// Returns the means of the entries' magnitudes over a part of the variety. They distinguish
  /// entries that are always small from entries that vanish somewhere.
  std::vector<double> typical_matrix() {
    std::vector<double> sum(jacobian_.rows() * jacobian_.columns());
    for (int number = 0; number < kStarts; ++number)
      if (const auto matrix = jacobian_.approx_at(start(number)))
        for (std::size_t e = 0; e < sum.size(); ++e) sum[e] += std::fabs((*matrix)[e]) / kStarts;
    return sum;
  }

  [[nodiscard]] MatrixXd scaled(const std::vector<double>& matrix) const {
    const RowMajor A = Eigen::Map<const RowMajor>(matrix.data(), Index(jacobian_.rows()),
                                                  Index(jacobian_.columns()));
    return scales_.row_scale.asDiagonal() * A * scales_.column_scale.asDiagonal();
  }

  /// Tries the step, and then shorter ones.
  std::optional<Place> improved(const Place& place) {
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
  VectorXd newton_step(const Place& place) {
    const MatrixXd A = scaled(place.matrix);
    const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const VectorXd v = svd.matrixV().rightCols<1>();
    const Index m = A.rows(), n = A.cols(), d = Index(place.point.size());
    MatrixXd system = MatrixXd::Zero(m + 1, d + n);
    for (Index k = 0; k < d; ++k) system.col(k).head(m) = slope(place, A, v, std::size_t(k));
    system.block(0, d, m, n) = A;
    system.block(m, d, 1, n) = v.transpose();
    VectorXd aim = VectorXd::Zero(m + 1);
    aim.head(m) = -(A * v);
    VectorXd step = system.completeOrthogonalDecomposition().solve(aim).head(d);
    for (Index k = 0; k < d; ++k) step(k) *= width(std::size_t(k));
    return step;
  }

  [[nodiscard]] double width(std::size_t k) const noexcept { return ranges_[k].hi - ranges_[k].lo; }

  /// Returns the change of A·v per width of variable k; zero if it is not known.
  VectorXd slope(const Place& place, const MatrixXd& A, const VectorXd& v, std::size_t k) {
    const double x = place.point[k].lo;
    const double up = within(ranges_[k], x + kDifference * width(k)).lo;
    const double other = up > x ? up : within(ranges_[k], x - kDifference * width(k)).lo;
    if (other == x || exhausted()) return VectorXd::Zero(A.rows());
    ++evaluations_;
    std::vector<Interval> point = place.point;
    point[k] = Interval(other);
    const auto matrix = jacobian_.approx_at(point);
    if (!matrix) return VectorXd::Zero(A.rows());
    return (scaled(*matrix) - A) * v * (width(k) / (other - x));
  }

  InverseJacobian jacobian_;
  Program constraints_;
  std::vector<Interval> ranges_;
  BalancedMatrix scales_;
  std::minstd_rand random_;
  std::size_t evaluations_ = 0;
  std::size_t most_evaluations_;
};

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
  Descent descent(p);
  std::optional<Descent::Place> best;
  for (int number = -1; number < kStarts && !descent.exhausted(); ++number) {
    if (number < 0 && box.empty()) continue;
    auto place = descent.from(number < 0 ? descent.middle_of(box) : descent.start(number));
    if (place && (!best || place->singular_value < best->singular_value)) best = std::move(place);
    if (best && best->singular_value <= kNegligible) break;
  }
  if (!best) return std::nullopt;
  const auto degeneracy = descent.jacobian().approx_degeneracy(best->point);
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
