// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/along_direction.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail {
namespace {

using Doubles = std::vector<double>;

constexpr double kMostContraction = 0.5;

Interval about_zero(double radius) { return {-radius, radius}; }

}  // namespace

AlongDirection::AlongDirection(const ForceProblem& problem, const BoxMatrix& box,
                               const Doubles& weight, const Doubles& scaled_inverse,
                               const Doubles& near, bool over_box)
    : problem_(problem),
      box_(box),
      m_(problem.rows),
      n_(problem.columns),
      parameters_(over_box ? box.radius.size() : 0),
      y_(near.begin(), near.end()) {
  if (std::ranges::find(problem.is_free, true) == problem.is_free.end()) return;
  const Interval z = bound_of_steps(weight, scaled_inverse);
  is_found_ = is_bounded(z);
  for (std::size_t j = 0; is_found_ && j < n_; ++j)
    for (std::size_t g = 0; g < m_; ++g)
      if (problem_.is_free[g])
        y_[j] += about_zero(mul_ru(std::fabs(scaled_inverse[j * m_ + g]), z.hi));
}

/// Returns max|WFy|/(1 − p), with the direction y as it was given; not bounded if p may be large.
Interval AlongDirection::bound_of_steps(const Doubles& weight,
                                        const Doubles& scaled_inverse) const {
  double residual = 0, contraction = 0;
  for (std::size_t f = 0; f < m_; ++f) {
    if (!problem_.is_free[f]) continue;
    if (!(weight[f] > 0) || !std::isfinite(weight[f])) return kEntire;
    Interval power(0.0);
    for (std::size_t j = 0; j < n_; ++j) power += entry(f, j) * y_[j];
    residual = std::fmax(residual, mul_ru(weight[f], mag(power)));
    double row = 0;
    for (std::size_t g = 0; g < m_; ++g) {
      if (!problem_.is_free[g]) continue;
      Interval sum(f == g ? -1.0 : 0.0);
      for (std::size_t j = 0; j < n_; ++j)
        sum += Interval(weight[f]) * entry(f, j) * Interval(scaled_inverse[j * m_ + g]);
      row = add_ru(row, mag(sum));
    }
    contraction = std::fmax(contraction, row);
  }
  if (!(contraction < kMostContraction) || !std::isfinite(residual)) return kEntire;
  return Interval(residual) / (Interval(1.0) - Interval(contraction));
}

/// Encloses an entry of A at c, or over the box.
Interval AlongDirection::entry(std::size_t i, std::size_t j) const {
  Interval value = box_.center[i * n_ + j];
  for (std::size_t k = 0; k < parameters_; ++k)
    value += about_zero(mul_ru(mag(slope(k, i, j)), box_.radius[k]));
  return value;
}

/// Encloses (A(c)y)_i.
Interval AlongDirection::along(std::size_t i) const {
  Interval sum(0.0);
  for (std::size_t j = 0; j < n_; ++j) sum += box_.center[i * n_ + j] * y_[j];
  return sum;
}

Interval AlongDirection::needed(std::size_t corner) const {
  Interval needed(0.0);
  for (std::size_t j = 0; j < n_; ++j) needed += problem_.corners[corner][j] * y_[j];
  for (const LoadBall& ball : problem_.balls) {
    Interval squares(0.0);
    for (const std::size_t j : ball.members) squares += sqr(y_[j]);
    needed += ball.radius * sqrt(squares);
  }
  return needed;
}

Interval AlongDirection::possible() const {
  Doubles attained(m_), spread(m_, 0.0);
  Interval sum(0.0);
  for (std::size_t i = 0; i < m_; ++i) {
    if (problem_.is_free[i]) continue;
    const Interval a = along(i);
    attained[i] = mid(a) > 0 ? problem_.possible[i].hi : problem_.possible[i].lo;
    sum += Interval(attained[i]) * a;
  }
  for (std::size_t k = 0; k < parameters_; ++k) {
    Interval together(0.0);
    for (std::size_t i = 0; i < m_; ++i) {
      if (problem_.is_free[i]) continue;
      Interval one(0.0);
      for (std::size_t j = 0; j < n_; ++j) one += slope(k, i, j) * y_[j];
      together += Interval(attained[i]) * one;
      spread[i] = add_ru(spread[i], mul_ru(mag(one), box_.radius[k]));
    }
    sum += about_zero(mul_ru(mag(together), box_.radius[k]));
  }
  for (std::size_t i = 0; i < m_; ++i) {
    if (problem_.is_free[i]) continue;
    const Interval& limits = problem_.possible[i];
    const Interval other(attained[i] == limits.hi ? limits.lo : limits.hi);
    const Interval gain = (other - Interval(attained[i])) * (along(i) + about_zero(spread[i]));
    sum += Interval(0, std::fmax(0, gain.hi));
  }
  return sum;
}

}  // namespace regulus::detail
