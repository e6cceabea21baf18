// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/witness/tolerance_balls.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/random_source.hpp"

namespace regulus::detail {
namespace {

constexpr double kCenter[] = {0.1, -7.3, 1e6};

/// A parameter, and a point within 2 of the center; the ends of the cube are rounded inward.
class OneBall {
 public:
  OneBall() {
    const double half = 2.0 / std::sqrt(3.0) * (1.0 - 0x1p-50);
    for (std::size_t i = 0; i < 3; ++i) {
      const double c = kCenter[i];
      nominal_[2 * i + 2] = nominal_[2 * i + 3] = c;
      problem.outer.emplace_back(sub_rd(c, 2.0), add_ru(c, 2.0));
      problem.inner.emplace_back(Interval(sub_ru(c, half), add_rd(c, half)));
    }
    expansion_.row_of_variable = rows_.data();
    expansion_.ball_of_variable = balls_.data();
    expansion_.nominal = nominal_.data();
    kernel_.variables = 4;
    kernel_.expansion = &expansion_;
    problem.kernel = &kernel_;
  }

  Problem problem{.outer = {{0.0, 1.0}}, .inner = {Interval(0.0, 1.0)}};

 private:
  std::array<int, 4> rows_ = {-1, 0, 0, 0}, balls_ = {-1, 0, 0, 0};
  std::array<double, 8> nominal_{};
  regulus_expansion expansion_{};
  regulus_kernel kernel_{};
};

long double distance_to_center(std::span<const double> x) {
  long double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const long double d = static_cast<long double>(x[i + 1]) - kCenter[i];
    sum += d * d;
  }
  return std::sqrt(sum);
}

TEST(ToleranceBalls, FindsTheRadiusOfTheBallAroundTheCube) {
  const OneBall ball;
  const ToleranceBalls balls(ball.problem);
  ASSERT_EQ(balls.balls().size(), 1U);
  EXPECT_EQ(balls.balls()[0].members, (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_LE(balls.balls()[0].radius, 2.0);
  EXPECT_GT(balls.balls()[0].radius, 2.0 - 1e-9);
  EXPECT_FALSE(balls.axis(0));
  ASSERT_TRUE(balls.axis(1));
  EXPECT_GT(balls.axis(1)->hi, kCenter[0] + 2.0 - 1e-6);
}

TEST(ToleranceBalls, PullsPointsIntoTheBallAndLeavesThoseInside) {
  const OneBall ball;
  const ToleranceBalls balls(ball.problem);
  test::RandomSource random(1);
  for (int trial = 0; trial < 1000; ++trial) {
    std::array<double, 4> x{0.5};
    for (std::size_t i = 0; i < 3; ++i) x[i + 1] = kCenter[i] + random.between(-2.0, 2.0);
    const std::array<double, 4> before = x;
    const bool inside = balls.certain_inside(x);
    if (inside) {
      EXPECT_LE(distance_to_center(x), 2.0L);
    }
    balls.pull_in(x);
    EXPECT_TRUE(balls.certain_inside(x));
    EXPECT_LE(distance_to_center(x), 2.0L);
    EXPECT_EQ(x == before, inside);
    if (!inside) {
      EXPECT_GT(distance_to_center(x), 2.0L - 1e-6L);
    }
  }
}

TEST(ToleranceBalls, TakesNoCornerOfTheBoxForAPointOfTheBall) {
  const OneBall ball;
  const ToleranceBalls balls(ball.problem);
  const std::array<double, 4> corner{0.5, kCenter[0] + 1.5, kCenter[1] + 1.5, kCenter[2] + 1.5};
  EXPECT_FALSE(balls.certain_inside(corner));
}

TEST(ToleranceBalls, AreNoneWithoutAMiddle) {
  OneBall ball;
  regulus_kernel kernel = *ball.problem.kernel;
  regulus_expansion expansion = *kernel.expansion;
  expansion.nominal = nullptr;
  kernel.expansion = &expansion;
  ball.problem.kernel = &kernel;
  EXPECT_TRUE(ToleranceBalls(ball.problem).balls().empty());
}

}  // namespace
}  // namespace regulus::detail
