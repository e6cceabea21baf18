// SPDX-License-Identifier: Apache-2.0
#include "runtime/witness/tolerance_balls.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail {
namespace {

/// Returns the distance from the middle to which points are pulled in: less than the radius by a
/// small part, and by more than the rounding of the coordinates.
double pulled_in_distance(const ToleranceBalls::Ball& ball) noexcept {
  double size = 0.0;
  for (const Interval& x : ball.center) size += mag(x) + ball.radius;
  return std::max(0.0, ball.radius * (1.0 - 0x1p-40) - size * 0x1p-49);
}

/// Returns the distance from any point of `center` to the farther end of the range, rounded down.
double distance_to_far_end_rd(Interval center, Interval range) noexcept {
  return std::max({0.0, sub_rd(range.hi, center.hi), sub_rd(center.lo, range.lo)});
}

double distance_to_center_ru(const ToleranceBalls::Ball& ball,
                             std::span<const double> variables) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < ball.members.size(); ++i) {
    const double x = variables[ball.members[i]];
    const double distance = std::max(sub_ru(x, ball.center[i].lo), sub_ru(ball.center[i].hi, x));
    sum = add_ru(sum, mul_ru(distance, distance));
  }
  return sqrt_ru(sum);
}

/// Returns the ball with the members that the problem has; nullopt if its middle is not known.
std::optional<ToleranceBalls::Ball> certain_ball(const Problem& problem, int number) {
  const regulus_expansion& expansion = *problem.kernel->expansion;
  ToleranceBalls::Ball ball;
  double sum = 0.0;
  for (std::size_t k = 0; k < problem.inner.size(); ++k) {
    if (expansion.ball_of_variable[k] != number) continue;
    if (expansion.row_of_variable[k] < 0 || !problem.inner[k]) return std::nullopt;
    const Interval center(expansion.nominal[2 * k], expansion.nominal[2 * k + 1]);
    const double distance = distance_to_far_end_rd(center, *problem.inner[k]);
    sum = add_rd(sum, mul_rd(distance, distance));
    ball.members.push_back(k);
    ball.center.push_back(center);
  }
  ball.radius = sqrt_rd(sum);
  return ball;
}

}  // namespace

ToleranceBalls::ToleranceBalls(const Problem& problem) {
  const regulus_expansion* expansion = problem.kernel->expansion;
  if (expansion == nullptr || expansion->ball_of_variable == nullptr ||
      expansion->nominal == nullptr || expansion->row_of_variable == nullptr)
    return;
  const std::span<const int> numbers(expansion->ball_of_variable, problem.inner.size());
  const int count = numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end()) + 1;
  for (int number = 0; number < count; ++number)
    if (auto ball = certain_ball(problem, number); ball && ball->radius > 0.0)
      balls_.push_back(std::move(*ball));
}

std::optional<Interval> ToleranceBalls::axis(std::size_t variable) const noexcept {
  for (const Ball& ball : balls_)
    for (std::size_t i = 0; i < ball.members.size(); ++i) {
      if (ball.members[i] != variable) continue;
      const double radius = pulled_in_distance(ball);
      const double lo = add_ru(ball.center[i].hi, -radius), hi = add_rd(ball.center[i].lo, radius);
      return lo <= hi ? Interval(lo, hi) : Interval(mid(ball.center[i]));
    }
  return std::nullopt;
}

void ToleranceBalls::pull_in(std::span<double> variables) const noexcept {
  for (const Ball& ball : balls_) {
    const double distance = distance_to_center_ru(ball, variables);
    if (distance <= ball.radius) continue;
    const double part = pulled_in_distance(ball) / distance;
    for (std::size_t i = 0; i < ball.members.size(); ++i) {
      const double middle = mid(ball.center[i]);
      double& x = variables[ball.members[i]];
      x = middle + (x - middle) * part;
    }
  }
}

bool ToleranceBalls::certain_inside(std::span<const double> variables) const noexcept {
  return std::all_of(balls_.begin(), balls_.end(), [&](const Ball& ball) {
    return distance_to_center_ru(ball, variables) <= ball.radius;
  });
}

}  // namespace regulus::detail
