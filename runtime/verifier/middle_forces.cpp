// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/middle_forces.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::verifier {
namespace {

constexpr double kFirstWeight = 4, kWeightGrowth = 8, kLastWeight = 1e6;
constexpr int kStepsOfNewton = 30;  ///< of Newton's method, for each weight
constexpr double kCentred = 0.1;    ///< Newton decrement at which the next weight begins

using Doubles = std::vector<double>;

/// u = u0 + Πz with Π = I − B·B⁺, whose image has Bᵀu = 0; |u_i| < s for every force i that is neither given nor
/// without limits. The
/// barrier is weight·s − Σ log(s² − u_i²).
class Barrier {
 public:
  Barrier(const ScaledRows& scaled, Doubles u0)
      : m_(scaled.rows), u_(std::move(u0)), projector_(m_ * m_), counts_(m_) {
    const std::size_t n = scaled.columns;
    for (std::size_t i = 0; i < m_; ++i)
      for (std::size_t k = 0; k < m_; ++k) {
        double sum = i == k ? 1.0 : 0.0;
        for (std::size_t j = 0; j < n; ++j) sum -= scaled.B[i * n + j] * scaled.inverse[k * n + j];
        projector_[i * m_ + k] = sum;
      }
    for (std::size_t i = 0; i < m_; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (scaled.B[i * n + j] != 0.0 && !scaled.has_no_limits[i]) counts_[i] = true;
    s_ = 2 * largest();
  }

  void minimise() {
    for (double weight = kFirstWeight; weight < kLastWeight; weight *= kWeightGrowth)
      for (int step = 0; step < kStepsOfNewton; ++step)
        if (!(move(weight) > kCentred)) break;
  }

  [[nodiscard]] const Doubles& offsets() const { return u_; }
  /// Returns the multipliers of the constraints |u_i| ≤ s, with the sign of u_i.
  [[nodiscard]] Doubles multipliers() const {
    Doubles result(m_);
    for (std::size_t i = 0; i < m_; ++i)
      if (counts_[i]) result[i] = 1 / (s_ - u_[i]) - 1 / (s_ + u_[i]);
    return result;
  }
  [[nodiscard]] double largest() const {
    double most = 0;
    for (std::size_t i = 0; i < m_; ++i)
      if (counts_[i]) most = std::max(most, std::fabs(u_[i]));
    return most;
  }

 private:
  /// Makes a damped step, which stays inside; returns the Newton decrement.
  double move(double weight) {
    Doubles slope(m_), curvature(m_, 1.0), mixed(m_);
    double slope_of_s = weight, curvature_of_s = 0;
    for (std::size_t i = 0; i < m_; ++i) {
      if (!counts_[i]) continue;
      const double above = 1 / (s_ - u_[i]), below = 1 / (s_ + u_[i]);
      slope[i] = above - below;
      curvature[i] = above * above + below * below;
      mixed[i] = below * below - above * above;
      slope_of_s -= above + below;
      curvature_of_s += curvature[i];
    }
    const std::size_t n = m_ + 1;
    Doubles H(n * n), g(n);
    for (std::size_t i = 0; i < m_; ++i) {
      for (std::size_t k = 0; k < m_; ++k) {
        double sum = (i == k ? 1.0 : 0.0) - projector_[i * m_ + k];
        for (std::size_t l = 0; l < m_; ++l)
          sum += projector_[i * m_ + l] * curvature[l] * projector_[l * m_ + k];
        H[i * n + k] = sum;
      }
      for (std::size_t l = 0; l < m_; ++l) {
        g[i] += projector_[i * m_ + l] * slope[l];
        H[i * n + m_] += projector_[i * m_ + l] * mixed[l];
      }
      H[m_ * n + i] = H[i * n + m_];
    }
    H[m_ * n + m_] = curvature_of_s;
    g[m_] = slope_of_s;
    return step_along(H, g);
  }

  double step_along(const Doubles& H, const Doubles& g) {
    const std::size_t n = m_ + 1;
    Matrix inverse;
    if (!approx_left_inverse(H, n, n, inverse)) return 0;
    Doubles step(n);
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = 0; i < n; ++i) step[i] -= inverse[k * n + i] * g[k];
    double decrement = 0;
    for (std::size_t i = 0; i < n; ++i) decrement -= g[i] * step[i];
    decrement = std::sqrt(std::max(0.0, decrement));
    const double length = decrement > 0.25 ? 1 / (1 + decrement) : 1;
    for (std::size_t i = 0; i < m_; ++i)
      for (std::size_t k = 0; k < m_; ++k) u_[i] += length * projector_[i * m_ + k] * step[k];
    s_ += length * step[m_];
    return decrement;
  }

  const std::size_t m_;
  Doubles u_;
  double s_ = 0;
  Doubles projector_;
  std::vector<bool> counts_;
};

}  // namespace

MiddleForces approx_middle_forces(const ScaledRows& scaled, const std::vector<double>& needed) {
  const std::size_t m = scaled.rows, n = scaled.columns;
  Doubles u0(m), multipliers(m);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < n; ++j) u0[i] += scaled.inverse[i * n + j] * needed[j];
  double unit = 0;
  for (const double u : u0) unit = std::max(unit, std::fabs(u));
  MiddleForces result{u0, Doubles(n)};
  if (m == n || !(unit > 0)) {
    std::size_t far = 0;
    double most = -1;
    for (std::size_t i = 0; i < m; ++i)
      if (!scaled.has_no_limits[i] && std::fabs(u0[i]) > most) most = std::fabs(u0[far = i]);
    multipliers[far] = u0[far] < 0 ? -1 : 1;
  } else {
    for (double& u : u0) u /= unit;
    Barrier barrier(scaled, u0);
    barrier.minimise();
    multipliers = barrier.multipliers();
    for (std::size_t i = 0; i < m; ++i) result.offsets[i] = unit * barrier.offsets()[i];
  }
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < n; ++j)
      result.direction[j] += scaled.inverse[i * n + j] * multipliers[i];
  return result;
}

}  // namespace regulus::verifier
