// SPDX-License-Identifier: Apache-2.0
#include "runtime/certificate/verifier/load_test.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/certificate/verifier/derivative.hpp"
#include "runtime/certificate/verifier/rounding.hpp"

namespace regulus::verifier {
namespace {

using Doubles = std::vector<double>;

constexpr double kNarrowest = 0x1p-44;  ///< of a range, relative to the variety's
constexpr int kCorrections = 30;
constexpr double kMoreCorrection = 1.02;

Interval symmetric(double radius) { return {-radius, radius}; }
double times_ru(double x, double y) { return x == 0.0 || y == 0.0 ? 0.0 : up(x * y); }
double plus_ru(double x, double y) { return up(x + y); }

bool is_moderate(const std::vector<Interval>& values) {
  return std::all_of(values.begin(), values.end(), [](Interval x) { return mag(x) <= kLargest; });
}

}  // namespace

LoadTest::LoadTest(Question& question, const Variety& variety)
    : q_(question),
      variety_(variety),
      bounds_(enclose_load(question)),
      m_(question.rows),
      n_(question.columns),
      defined_(question, join({&question.matrix, &question.defined, &question.motion_defined})),
      outside_(question, variety) {
  for (const Interval limits : bounds_.certain) weight_.push_back(limits.hi / 2 - limits.lo / 2);
  differentiate();
  at_middle_.emplace(q_, q_.matrix);
  std::vector<NodeId> roots;
  for (const SlopesOf& slopes : slopes_)
    for (const Slope& slope : slopes.entries) roots.push_back(slope.node);
  over_box_.emplace(q_, roots);
}

void LoadTest::differentiate() {
  for (std::size_t k = 0; k < q_.variables.size(); ++k) {
    Differentiator by(q_.graph, k);
    SlopesOf slopes{k, {}};
    for (std::size_t e = 0; e < q_.matrix.size(); ++e)
      if (const NodeId node = by.of(q_.matrix[e]); node != kNoNode)
        slopes.entries.push_back({e / n_, e % n_, node});
    if (!slopes.entries.empty()) slopes_.push_back(std::move(slopes));
  }
}

LoadTest::Answer LoadTest::decide(const Box& box, Claim claim) {
  impact_.assign(box.size(), 0.0);
  place_middle(variety_, box, middle_);
  if (outside_.covers(box)) return Answer::kOutside;
  if (claim == Claim::kOutside || !enclose(box) || !find_inverse()) return Answer::kOpen;
  bound_error();
  const auto test = [&](const Intervals& wrench) {
    return claim == Claim::kHeld ? is_held(wrench) : is_not_held(wrench);
  };
  const bool is_proved = claim == Claim::kHeld
                             ? std::all_of(bounds_.corners.begin(), bounds_.corners.end(), test)
                             : std::any_of(bounds_.corners.begin(), bounds_.corners.end(), test);
  return is_proved ? Answer::kProved : Answer::kOpen;
}

/// Encloses A at the middle and its derivatives over the box; if these are not bounded, A over the
/// box.
bool LoadTest::enclose(const Box& box) {
  if (!defined_.run(box)) return false;
  has_slopes_ = over_box_->run(box) && at_middle_->run(middle_.point);
  A_.clear(), dA_.clear(), radius_.clear();
  for (const NodeId entry : q_.matrix)
    A_.push_back(has_slopes_ ? at_middle_->value(entry) : defined_.value(entry));
  for (std::size_t s = 0; has_slopes_ && s < slopes_.size(); ++s) {
    dA_.emplace_back();
    for (const Slope& slope : slopes_[s].entries)
      dA_.back().push_back(over_box_->value(slope.node));
    radius_.push_back(middle_.radius[slopes_[s].variable]);
    if (!is_moderate(dA_.back())) return false;
  }
  return is_moderate(A_) && verifier::is_moderate(radius_) && is_moderate(bounds_.possible) &&
         std::all_of(bounds_.balls.begin(), bounds_.balls.end(),
                     [](const LoadBounds::Ball& ball) { return ball.radius.hi <= kLargest; }) &&
         std::all_of(bounds_.corners.begin(), bounds_.corners.end(),
                     [](const Intervals& corner) { return is_moderate(corner); });
}

/// Finds K for rows in units of the ranges of the forces: it shares a change of the load among them.
bool LoadTest::find_inverse() {
  scaled_ = {m_, n_, Doubles(m_ * n_), {}};
  for (std::size_t e = 0; e < A_.size(); ++e) scaled_.B[e] = weight_[e / n_] * mid(A_[e]);
  if (!verifier::is_moderate(scaled_.B) || !approx_left_inverse(scaled_.B, m_, n_, scaled_.inverse))
    return false;
  K_ = scaled_.inverse;
  for (std::size_t e = 0; e < K_.size(); ++e) K_[e] *= weight_[e / n_];
  return verifier::is_moderate(K_) && verifier::is_moderate(scaled_.inverse);
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
  for (std::size_t s = 0; s < dA_.size(); ++s) {
    Intervals product(n_ * n_);
    const std::vector<Slope>& entries = slopes_[s].entries;
    for (std::size_t e = 0; e < entries.size(); ++e)
      for (std::size_t j = 0; j < n_; ++j) {
        Interval& sum = product[j * n_ + entries[e].column];
        sum = sum + K(j, entries[e].row) * dA_[s][e];
      }
    for (std::size_t e = 0; e < product.size(); ++e) {
      const double part = times_ru(mag(product[e]), radius_[s]);
      error_[e] = plus_ru(error_[e], part);
      impact_[slopes_[s].variable] += part;
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
  if (!verifier::is_moderate(forces)) return false;
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
  for (std::size_t s = 0; s < dA_.size(); ++s) {
    Intervals slope(n_);  // of Aᵀf₀
    const std::vector<Slope>& entries = slopes_[s].entries;
    for (std::size_t e = 0; e < entries.size(); ++e) {
      Interval& sum = slope[entries[e].column];
      sum = sum + forces[entries[e].row] * dA_[s][e];
    }
    for (std::size_t j = 0; j < n_; ++j)
      of_residual[j] = plus_ru(of_residual[j], times_ru(mag(slope[j]), radius_[s]));
    for (std::size_t i = 0; i < m_; ++i) {
      Interval force;
      for (std::size_t j = 0; j < n_; ++j) force = force + K(j, i) * slope[j];
      const double part = times_ru(mag(force), radius_[s]);
      moving[i] = plus_ru(moving[i], part);
      if (weight_[i] > 0.0) impact_[slopes_[s].variable] += part / weight_[i];
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
    if (is_proved && verifier::is_moderate(y)) return y;
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
  if (!verifier::is_moderate(direction)) return false;
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
  for (std::size_t s = 0; s < dA_.size(); ++s) {
    Intervals by_row(m_);
    Interval together;
    for (std::size_t e = 0; e < dA_[s].size(); ++e) {
      const Slope& slope = slopes_[s].entries[e];
      by_row[slope.row] = by_row[slope.row] + y[slope.column] * dA_[s][e];
    }
    for (std::size_t i = 0; i < m_; ++i) {
      together = together + attained[i] * by_row[i];
      spread[i] = plus_ru(spread[i], times_ru(mag(by_row[i]), radius_[s]));
    }
    const double part = times_ru(mag(together), radius_[s]);
    sum = sum + symmetric(part);
    impact_[slopes_[s].variable] += part;
  }
  for (std::size_t i = 0; i < m_; ++i) {
    const Interval limits = bounds_.possible[i];
    const double other = attained[i] == limits.hi ? limits.lo : limits.hi;
    const Interval gain = (point(other) - point(attained[i])) * (a[i] + symmetric(spread[i]));
    sum = sum + Interval{0.0, std::max(0.0, gain.hi)};
  }
  return sum;
}

std::optional<std::size_t> LoadTest::variable_to_split(const Box& box) const {
  const bool has_impact = std::any_of(impact_.begin(), impact_.end(),
                                      [](double x) { return x > 0.0 && std::isfinite(x); });
  std::optional<std::size_t> best;
  double most = 0.0;
  for (std::size_t k = 0; k < box.size(); ++k) {
    const Interval x = box[k], root = variety_.outer[k];
    const double middle = mid(x), width = (x.hi - x.lo) / (root.hi - root.lo);
    if (!(x.lo < middle && middle < x.hi && width > kNarrowest)) continue;
    const double score = has_impact ? impact_[k] : width;
    if (score > most) best = k, most = score;
  }
  return best;
}

}  // namespace regulus::verifier
