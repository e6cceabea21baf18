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

double LoadTest::length_of_row(std::size_t row) const {
  double length = 0.0;
  for (std::size_t j = 0; j < n_; ++j) length = std::hypot(length, mid(A(row, j)));
  return length;
}

/// Rows without limits are long: their forces cost nothing.
void LoadTest::weigh_free_rows() {
  constexpr double kMuchLonger = 1024.0;
  double longest = 0.0;
  for (std::size_t i = 0; i < m_; ++i)
    if (!bounds_.is_free[i]) longest = std::max(longest, weight_[i] * length_of_row(i));
  for (std::size_t i = 0; i < m_; ++i) {
    if (!bounds_.is_free[i]) continue;
    const double own = length_of_row(i);
    weight_[i] = own > 0.0 && longest > 0.0 ? kMuchLonger * longest / own : 1.0;
  }
}

/// Finds K for rows in units of the ranges of the forces: it shares a change of the load among them.
bool LoadTest::find_inverse() {
  weigh_free_rows();
  scaled_ = {m_, n_, Doubles(m_ * n_), {}, bounds_.is_free};
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
      if (weight_[i] > 0.0 && !bounds_.is_free[i])
        impact_[slopes_.of()[s].variable] += part / weight_[i];
    }
  }
  const Doubles correction = bound_correction(of_residual);
  if (correction.empty()) return false;
  for (std::size_t i = 0; i < m_; ++i) {
    Interval force = point(forces[i]) + symmetric(moving[i]) + symmetric(ball_force(i));
    for (std::size_t j = 0; j < n_; ++j)
      force = force + K(j, i) * (residual[j] + symmetric(correction[j]));
    if (bounds_.is_free[i]) continue;
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
  const Intervals y = without_free_forces(direction);
  return !y.empty() && possible_along(y).hi < needed_along(y).lo;
}

/// Encloses an entry of A over the box.
Interval LoadTest::entry_over_box(std::size_t row, std::size_t column) const {
  Interval value = A(row, column);
  for (std::size_t s = 0; s < slopes_.of().size(); ++s) {
    const auto& entries = slopes_.of()[s].entries;
    for (std::size_t e = 0; e < entries.size(); ++e)
      if (entries[e].row == row && entries[e].column == column)
        value = value + symmetric(times_ru(mag(slopes_.slope(s, e)), slopes_.radius(s)));
  }
  return value;
}

/// Encloses, at each point of the box, y − Sz with Fy = FSz, for the rows F without limits and S of K:
/// |z| ≤ max|WFy|/(1 − p), |I − WFS| ≤ p. Empty if p is not small.
LoadTest::Intervals LoadTest::without_free_forces(const Doubles& near) const {
  constexpr double kSmall = 0.5;
  Intervals y(n_);
  for (std::size_t j = 0; j < n_; ++j) y[j] = point(near[j]);
  double residual = 0.0, contraction = 0.0;
  for (std::size_t f = 0; f < m_; ++f) {
    if (!bounds_.is_free[f]) continue;
    Intervals row(n_);
    Interval power;
    for (std::size_t j = 0; j < n_; ++j) {
      row[j] = weight_[f] * entry_over_box(f, j);
      power = power + near[j] * row[j];
    }
    double sum = 0.0;
    for (std::size_t g = 0; g < m_; ++g) {
      if (!bounds_.is_free[g]) continue;
      Interval product = point(f == g ? -1.0 : 0.0);
      for (std::size_t j = 0; j < n_; ++j) product = product + scaled_.inverse[g * n_ + j] * row[j];
      sum = plus_ru(sum, mag(product));
    }
    if (!(mag(power) <= kLargest) || !(sum <= kSmall)) return {};
    residual = std::max(residual, mag(power));
    contraction = std::max(contraction, sum);
  }
  if (!(residual > 0.0)) return y;
  const double z = up(residual / down(1.0 - contraction));
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t g = 0; g < m_; ++g)
      if (bounds_.is_free[g])
        y[j] = y[j] + symmetric(times_ru(std::fabs(scaled_.inverse[g * n_ + j]), z));
  return y;
}

/// Encloses the greatest yᵀw of the load.
Interval LoadTest::needed_along(const Intervals& y) const {
  Interval sum;
  for (std::size_t j = 0; j < n_; ++j)
    sum = sum + y[j] * bounds_.middle[j] + Interval{mig(y[j]), mag(y[j])} * bounds_.spread[j];
  for (const LoadBounds::Ball& ball : bounds_.balls) {
    Interval squares;
    for (const std::size_t j : ball.members) squares = squares + square(y[j]);
    sum = sum + ball.radius * sqrt(squares);
  }
  return sum;
}

/// Encloses (A(c)y)_i.
Interval LoadTest::along(std::size_t row, const Intervals& y) const {
  Interval sum;
  for (std::size_t j = 0; j < n_; ++j) sum = sum + y[j] * A(row, j);
  return sum;
}

/// Bounds the greatest fᵀAy of forces within the limits, at every point of the box. Forces without
/// limits have no power along y.
Interval LoadTest::possible_along(const Intervals& y) {
  Intervals a(m_);
  Doubles spread(m_), attained(m_);
  Interval sum;
  for (std::size_t i = 0; i < m_; ++i) {
    if (bounds_.is_free[i]) continue;
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
      if (bounds_.is_free[i]) continue;
      together = together + attained[i] * by_row[i];
      spread[i] = plus_ru(spread[i], times_ru(mag(by_row[i]), slopes_.radius(s)));
    }
    const double part = times_ru(mag(together), slopes_.radius(s));
    sum = sum + symmetric(part);
    impact_[slopes_.of()[s].variable] += part;
  }
  for (std::size_t i = 0; i < m_; ++i) {
    if (bounds_.is_free[i]) continue;
    const Interval limits = bounds_.possible[i];
    const double other = attained[i] == limits.hi ? limits.lo : limits.hi;
    const Interval gain = (point(other) - point(attained[i])) * (a[i] + symmetric(spread[i]));
    sum = sum + Interval{0.0, std::max(0.0, gain.hi)};
  }
  return sum;
}

}  // namespace regulus::verifier
