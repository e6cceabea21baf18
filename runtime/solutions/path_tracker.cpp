// SPDX-License-Identifier: Apache-2.0
#include "runtime/solutions/path_tracker.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/solutions/linear_system.hpp"

namespace regulus::detail {

namespace {

using Point = std::vector<Complex>;

constexpr double kFirstStep = 0.05;
constexpr int kNewtonSteps = 3;
constexpr double kConverged = 1e-11;

class Tracker {
 public:
  Tracker(const Homotopy& homotopy, std::span<const Complex> start, const TrackerOptions& options)
      : homotopy_(homotopy),
        options_(options),
        n_(homotopy.unknowns()),
        groups_(homotopy.groups()),
        equations_(n_ - groups_.size()),
        z_(start.begin(), start.end()),
        values_(n_),
        rates_(n_),
        matrix_(n_ * n_) {}

  [[nodiscard]] std::optional<Point> track() {
    double t = 0, step = kFirstStep;
    for (int k = 0; k < options_.most_steps && t < 1; ++k) {
      step = std::min(step, 1 - t);
      if (step < options_.least_step && step < 1 - t) return std::nullopt;
      normalize();
      patch_ = z_;
      const double next = step < 1 - t ? t + step : 1;
      auto predicted = predict(t, next - t);
      const double error = predicted ? correct(*predicted, next) : kInfinity;
      if (error <= options_.tolerance) {
        z_ = std::move(*predicted);
        t = next;
      }
      step *= factor(error);
    }
    if (t < 1) return std::nullopt;
    normalize();
    return z_;
  }

 private:
  [[nodiscard]] double factor(double error) const {
    if (!(error < kInfinity)) return 0.25;
    const double wanted = 0.7 * std::pow(options_.tolerance / std::max(error, 1e-16), 0.2);
    return std::clamp(wanted, 0.2, 4.0);
  }

  void normalize() {
    std::size_t first = 0;
    for (const std::size_t width : groups_) {
      const auto group = std::span(z_).subspan(first, width);
      double sum = 0;
      for (const Complex& z : group) sum += norm(z);
      for (Complex& z : group) z = z * Complex(1 / std::sqrt(sum));
      first += width;
    }
  }

  /// Evaluates at t; the rows of the patch keep each group where it is normalized.
  void evaluate(const Point& z, double t) {
    const Complex gamma = options_.gamma;
    const Complex reciprocal = inverse(Complex{1 - t + gamma.re * t, gamma.im * t});
    const Complex s = t < 1 ? gamma * reciprocal * Complex(t) : Complex(1);
    homotopy_.evaluate(z, s, values_, matrix_, rates_);
    const Complex speed = gamma * reciprocal * reciprocal;
    for (std::size_t i = 0; i < equations_; ++i) rates_[i] = rates_[i] * speed;
    std::size_t first = 0, row = equations_;
    for (const std::size_t width : groups_) {
      values_[row] = rates_[row] = {};
      std::fill_n(matrix_.begin() + static_cast<std::ptrdiff_t>(row * n_), n_, Complex{});
      for (std::size_t i = first; i < first + width; ++i) matrix_[row * n_ + i] = conj(patch_[i]);
      first += width, ++row;
    }
  }

  /// dz/dt, with the sign changed
  [[nodiscard]] bool solve_for_tangent(const Point& z, double t) {
    evaluate(z, t);
    return solve_in_place(matrix_, rates_, n_);
  }

  [[nodiscard]] Point moved(std::span<const Complex> along, double by) const {
    Point result = z_;
    for (std::size_t i = 0; i < n_; ++i) result[i] -= along[i] * Complex(by);
    return result;
  }

  /// A step of Runge and Kutta of order four.
  [[nodiscard]] std::optional<Point> predict(double t, double step) {
    Point sum(n_);
    Point at = z_;
    for (const auto& [weight, place, next] :
         {std::array{1.0, 0.0, 0.5}, {2.0, 0.5, 0.5}, {2.0, 0.5, 1.0}, {1.0, 1.0, 0.0}}) {
      if (!solve_for_tangent(at, t + place * step)) return std::nullopt;
      for (std::size_t i = 0; i < n_; ++i) sum[i] += rates_[i] * Complex(weight / 6);
      at = moved(rates_, next * step);
    }
    return moved(sum, step);
  }

  /// Newton's method. Returns the length of its first step, or infinity if it does not converge.
  [[nodiscard]] double correct(Point& z, double t) {
    double first = 0, last = kInfinity;
    for (int k = 0; k < kNewtonSteps; ++k) {
      evaluate(z, t);
      if (!solve_in_place(matrix_, values_, n_)) return kInfinity;
      double length = 0;
      for (std::size_t i = 0; i < n_; ++i) {
        z[i] -= values_[i];
        length = std::max(length, norm(values_[i]));
      }
      length = std::sqrt(length);
      if (k == 0) first = length;
      if (!(length < kInfinity) || length > 2 * last) return kInfinity;
      if (length < kConverged) break;
      last = length;
    }
    return first;
  }

  const Homotopy& homotopy_;
  const TrackerOptions& options_;
  const std::size_t n_;
  const std::span<const std::size_t> groups_;
  const std::size_t equations_;
  Point z_, patch_, values_, rates_, matrix_;
};

}  // namespace

std::optional<std::vector<Complex>> track(const Homotopy& homotopy, std::span<const Complex> start,
                                          const TrackerOptions& options) {
  return Tracker(homotopy, start, options).track();
}

}  // namespace regulus::detail
