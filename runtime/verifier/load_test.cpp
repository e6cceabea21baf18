// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/load_test.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/verifier/rounding.hpp"

namespace regulus::verifier {
namespace {

using Doubles = std::vector<double>;

constexpr int kCorrections = 30;
constexpr double kMoreCorrection = 1.02;

Interval symmetric(double radius) { return {-radius, radius}; }
double times_ru(double x, double y) { return x == 0.0 || y == 0.0 ? 0.0 : up(x * y); }
double plus_ru(double x, double y) { return up(x + y); }

}  // namespace

LoadTest::LoadTest(Question& question, const Variety& variety)
    : variety_(variety),
      bounds_(enclose_load(question)),
      m_(question.rows),
      n_(question.columns),
      slopes_(question),
      outside_(question, variety) {
  for (const Interval limits : bounds_.certain) weight_.push_back(limits.hi / 2 - limits.lo / 2);
}

BoxAnswer LoadTest::decide(const Box& box, Claim claim) {
  impact_.assign(box.size(), 0.0);
  place_middle(variety_, box, middle_);
  if (outside_.covers(box)) return BoxAnswer::kOutside;
  if (claim == Claim::kOutside || !enclose(box) || !find_inverse()) return BoxAnswer::kOpen;
  bound_error();
  const auto test = [&](const Intervals& wrench) {
    return claim == Claim::kHeld ? is_held(wrench) : is_not_held(wrench);
  };
  const bool is_proved = claim == Claim::kHeld
                             ? std::all_of(bounds_.corners.begin(), bounds_.corners.end(), test)
                             : std::any_of(bounds_.corners.begin(), bounds_.corners.end(), test);
  return is_proved ? BoxAnswer::kProved : BoxAnswer::kOpen;
}

bool LoadTest::enclose(const Box& box) {
  return slopes_.run(box, middle_) && is_moderate(bounds_.possible) &&
         std::all_of(bounds_.balls.begin(), bounds_.balls.end(),
                     [](const LoadBounds::Ball& ball) { return ball.radius.hi <= kLargest; }) &&
         std::all_of(bounds_.corners.begin(), bounds_.corners.end(),
                     [](const Intervals& corner) { return is_moderate(corner); });
}

/// Finds K for rows in units of the ranges of the forces: it shares a change of the load among them.
bool LoadTest::find_inverse() {
  scaled_ = {m_, n_, Doubles(m_ * n_), {}};
  for (std::size_t e = 0; e < m_ * n_; ++e)
    scaled_.B[e] = weight_[e / n_] * mid(slopes_.entries()[e]);
  if (!is_moderate(scaled_.B) || !approx_left_inverse(scaled_.B, m_, n_, scaled_.inverse))
    return false;
  K_ = scaled_.inverse;
  for (std::size_t e = 0; e < K_.size(); ++e) K_[e] *= weight_[e / n_];
  return is_moderate(K_) && is_moderate(scaled_.inverse);
}

/// P = |K·A(c) − I| + Σ_k |K·∂_kA|·r_k.
void LoadTest::bound_error() {
  error_.assign(n_ * n_, 0.0);
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t l = 0; l < n_; ++l) {
      Interval sum = point(j == l ? -1.0 : 0.0);
      for (std::size_t i = 0; i < m_; ++i) sum = sum + K(j, i) * A(i, l);
      error_[j * n_ + l] = mag(sum);
    }
  for (std::size_t s = 0; s < slopes_.of().size(); ++s) {
    Intervals product(n_ * n_);
    const auto& entries = slopes_.of()[s].entries;
    for (std::size_t e = 0; e < entries.size(); ++e)
      for (std::size_t j = 0; j < n_; ++j) {
        Interval& sum = product[j * n_ + entries[e].column];
        sum = sum + K(j, entries[e].row) * slopes_.slope(s, e);
      }
    for (std::size_t e = 0; e < product.size(); ++e) {
      const double part = times_ru(mag(product[e]), slopes_.radius(s));
      error_[e] = plus_ru(error_[e], part);
      impact_[slopes_.of()[s].variable] += part;
    }
  }
}

MiddleForces LoadTest::middle_forces(const Intervals& wrench) const {
  Doubles needed(n_);
  for (std::size_t j = 0; j < n_; ++j) {
    needed[j] = mid(wrench[j]);
    for (std::size_t i = 0; i < m_; ++i) needed[j] -= mid(A(i, j)) * mid(bounds_.certain[i]);
  }
  return approx_middle_forces(scaled_, needed);
}

bool LoadTest::is_held(const Intervals& wrench) {
  Doubles forces = middle_forces(wrench).offsets;
  for (std::size_t i = 0; i < m_; ++i) forces[i] = mid(bounds_.certain[i]) + weight_[i] * forces[i];
  if (!is_moderate(forces)) return false;
  Intervals residual = wrench;
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t i = 0; i < m_; ++i) residual[j] = residual[j] - forces[i] * A(i, j);
  return is_within_limits(forces, residual);
}

/// `residual`: w − A(c)ᵀf₀.
bool LoadTest::is_within_limits(const Doubles& forces, const Intervals& residual) {
  Doubles moving(m_), of_residual(n_);
  for (std::size_t j = 0; j < n_; ++j) of_residual[j] = mag(residual[j]);
  for (const LoadBounds::Ball& ball : bounds_.balls)
    for (const std::size_t j : ball.members)
      of_residual[j] = plus_ru(of_residual[j], ball.radius.hi);
  for (std::size_t s = 0; s < slopes_.of().size(); ++s) {
    Intervals slope(n_);  // of Aᵀf₀
    const auto& entries = slopes_.of()[s].entries;
    for (std::size_t e = 0; e < entries.size(); ++e) {
      Interval& sum = slope[entries[e].column];
      sum = sum + forces[entries[e].row] * slopes_.slope(s, e);
    }
    for (std::size_t j = 0; j < n_; ++j)
      of_residual[j] = plus_ru(of_residual[j], times_ru(mag(slope[j]), slopes_.radius(s)));
    for (std::size_t i = 0; i < m_; ++i) {
      Interval force;
      for (std::size_t j = 0; j < n_; ++j) force = force + K(j, i) * slope[j];
      const double part = times_ru(mag(force), slopes_.radius(s));
      moving[i] = plus_ru(moving[i], part);
      if (weight_[i] > 0.0) impact_[slopes_.of()[s].variable] += part / weight_[i];
    }
  }
  const Doubles correction = bound_correction(of_residual);
  if (correction.empty()) return false;
  for (std::size_t i = 0; i < m_; ++i) {
    Interval force = point(forces[i]) + symmetric(moving[i]) + symmetric(ball_force(i));
    for (std::size_t j = 0; j < n_; ++j)
      force = force + K(j, i) * (residual[j] + symmetric(correction[j]));
    if (!(bounds_.certain[i].lo <= force.lo && force.hi <= bounds_.certain[i].hi)) return false;
  }
  return true;
}

/// Returns y > 0 with Pᵀ(|r| + y) < y; empty if none was found.
Doubles LoadTest::bound_correction(const Doubles& residual) const {
  Doubles y(n_, 0.0), next(n_);
  const auto image = [&](std::size_t j) {
    double sum = 0.0;
    for (std::size_t l = 0; l < n_; ++l)
      sum = plus_ru(sum, times_ru(error_[l * n_ + j], plus_ru(residual[l], y[l])));
    return sum;
  };
  for (int step = 0; step < kCorrections; ++step) {
    for (std::size_t j = 0; j < n_; ++j)
      next[j] = kMoreCorrection * image(j) + 1e-18 * residual[j] + 1e-290;
    y = next;
    bool is_proved = true;
    for (std::size_t j = 0; j < n_; ++j) is_proved = is_proved && y[j] > 0.0 && image(j) < y[j];
    if (is_proved && is_moderate(y)) return y;
  }
  return {};
}

/// Bounds what the balls of the load add to a force: R·‖the ball's part of a row of Kᵀ‖.
double LoadTest::ball_force(std::size_t row) const {
  Interval sum;
  for (const LoadBounds::Ball& ball : bounds_.balls) {
    Interval squares;
    for (const std::size_t j : ball.members) squares = squares + square(point(K(j, row)));
    sum = sum + ball.radius * sqrt(squares);
  }
  return mag(sum);
}

bool LoadTest::is_not_held(const Intervals& wrench) {
  const Doubles direction = middle_forces(wrench).direction;
  if (!is_moderate(direction)) return false;
  return possible_along(direction).hi < needed_along(direction).lo;
}

/// Encloses the greatest yᵀw of the load.
Interval LoadTest::needed_along(const Doubles& y) const {
  Interval sum;
  for (std::size_t j = 0; j < n_; ++j)
    sum = sum + y[j] * bounds_.middle[j] + std::fabs(y[j]) * bounds_.spread[j];
  for (const LoadBounds::Ball& ball : bounds_.balls) {
    Interval squares;
    for (const std::size_t j : ball.members) squares = squares + square(point(y[j]));
    sum = sum + ball.radius * sqrt(squares);
  }
  return sum;
}

/// Encloses (A(c)y)_i.
Interval LoadTest::along(std::size_t row, const Doubles& y) const {
  Interval sum;
  for (std::size_t j = 0; j < n_; ++j) sum = sum + y[j] * A(row, j);
  return sum;
}

/// Bounds the greatest fᵀAy of forces within the limits, at every point of the box.
Interval LoadTest::possible_along(const Doubles& y) {
  Intervals a(m_);
  Doubles spread(m_), attained(m_);
  Interval sum;
  for (std::size_t i = 0; i < m_; ++i) {
    a[i] = along(i, y);
    attained[i] = mid(a[i]) > 0.0 ? bounds_.possible[i].hi : bounds_.possible[i].lo;
    sum = sum + attained[i] * a[i];
  }
  for (std::size_t s = 0; s < slopes_.of().size(); ++s) {
    Intervals by_row(m_);
    Interval together;
    for (std::size_t e = 0; e < slopes_.of()[s].entries.size(); ++e) {
      const MatrixSlopes::Slope& slope = slopes_.of()[s].entries[e];
      by_row[slope.row] = by_row[slope.row] + y[slope.column] * slopes_.slope(s, e);
    }
    for (std::size_t i = 0; i < m_; ++i) {
      together = together + attained[i] * by_row[i];
      spread[i] = plus_ru(spread[i], times_ru(mag(by_row[i]), slopes_.radius(s)));
    }
    const double part = times_ru(mag(together), slopes_.radius(s));
    sum = sum + symmetric(part);
    impact_[slopes_.of()[s].variable] += part;
  }
  for (std::size_t i = 0; i < m_; ++i) {
    const Interval limits = bounds_.possible[i];
    const double other = attained[i] == limits.hi ? limits.lo : limits.hi;
    const Interval gain = (point(other) - point(attained[i])) * (a[i] + symmetric(spread[i]));
    sum = sum + Interval{0.0, std::max(0.0, gain.hi)};
  }
  return sum;
}

}  // namespace regulus::verifier
