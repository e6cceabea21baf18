// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/existence/narrowing.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace regulus::detail {
namespace {

TEST(NarrowingByRows, KeepsEverySolutionOfTheBox) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-2, 2), part(0, 1);
  int narrowed = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const std::size_t n = 1 + std::size_t(trial % 4);
    std::vector<double> point(n), c(n);
    std::vector<Interval> x, A(n * n), b(n);
    const double wide = trial % 3 == 0 ? 2 : 0.1;
    const auto about = [&](double value) {
      return Interval(value - wide * part(random), value + wide * part(random));
    };
    for (std::size_t i = 0; i < n; ++i) {
      point[i] = number(random), c[i] = number(random);
      x.push_back(about(point[i]));
    }
    for (std::size_t i = 0; i < n; ++i) {
      long double sum = 0;
      for (std::size_t j = 0; j < n; ++j) {
        const double a = number(random);
        A[i * n + j] = about(a);
        sum += static_cast<long double>(a) * (point[j] - static_cast<long double>(c[j]));
      }
      b[i] = about(double(-sum));
      b[i] = hull(b[i], Interval(double(-sum) - 1e-12, double(-sum) + 1e-12));
    }
    const std::vector<Interval> before = x;
    ASSERT_TRUE(narrow_by_rows(A, b, c, x)) << "trial " << trial;
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_TRUE(contains(x[i], point[i])) << "trial " << trial;
      EXPECT_TRUE(certain_subset(x[i], before[i]));
      narrowed += x[i] == before[i] ? 0 : 1;
    }
  }
  EXPECT_GT(narrowed, 2'000);
}

TEST(NarrowingByRows, LeavesBothSidesOfAGap) {
  std::vector<Interval> x = {Interval(-3, 4)};
  const std::vector<Interval> A = {Interval(-1, 2)}, b = {Interval(2, 3)};
  const std::vector<double> c = {0};
  ASSERT_TRUE(narrow_by_rows(A, b, c, x));  // x ≤ −1 or x ≥ 2
  EXPECT_EQ(x[0], Interval(-3, 4));
  x[0] = Interval(-0.5, 4);
  ASSERT_TRUE(narrow_by_rows(A, b, c, x));
  EXPECT_TRUE(contains(x[0], 2) && x[0].lo > 1.999 && x[0].hi == 4);
  x[0] = Interval(-0.5, 1.5);
  EXPECT_FALSE(narrow_by_rows(A, b, c, x));
}

}  // namespace
}  // namespace regulus::detail
