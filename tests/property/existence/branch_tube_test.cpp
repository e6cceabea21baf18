// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the parts of the test with exact rational numbers, and its answers with planted roots.
#include "runtime/existence/branch_tube.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/planted_cases.hpp"

namespace regulus::detail::test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(PlantedRoots, AreNeverTakenForOne) { expect_no_false_one(1, 5000); }

/// A tube, a box and enclosures of a system, all random.
struct RandomCase {
  explicit RandomCase(RandomSource& random) : n(1 + random.below(4)), m(random.below(4)) {
    const auto number = [&] { return corner_double(random, 40); };
    for (std::size_t i = 0; i < n; ++i) {
      tube.center.push_back(number()), tube.radius.push_back(std::abs(number()));
      value.push_back(corner_interval(random, 40));
    }
    for (std::size_t k = 0; k < m; ++k)
      tube.at.push_back(number()), box.push_back(corner_interval(random, 40));
    for (std::size_t e = 0; e < n * m; ++e) {
      tube.slopes.push_back(number());
      by_variable.push_back(corner_interval(random, 40));
    }
    for (std::size_t e = 0; e < n * n; ++e) {
      inverse.push_back(number());
      by_unknown.push_back(corner_interval(random, 40));
    }
  }

  std::size_t n, m;
  BranchTube tube;
  std::vector<Interval> box, value, by_unknown, by_variable;
  std::vector<double> inverse;
};

Exact member(RandomSource& random, const Interval& x) { return {point_of(random, x)}; }

TEST(TheImageOfATube, BoundsItsPartsForEveryMemberOfTheEnclosures) {
  RandomSource random(2);
  for (int round = 0; round < 2000; ++round) {
    const RandomCase c(random);
    const TubeImage image =
        image_of(c.tube, c.box, c.inverse, {c.value, c.by_unknown, c.by_variable});
    std::vector<Exact> value, by_unknown, by_variable, step;
    for (const Interval& x : c.value) value.push_back(member(random, x));
    for (const Interval& x : c.by_unknown) by_unknown.push_back(member(random, x));
    for (const Interval& x : c.by_variable) by_variable.push_back(member(random, x));
    for (std::size_t k = 0; k < c.m; ++k)
      step.push_back((member(random, c.box[k]) - Exact(c.tube.at[k])).abs());
    for (std::size_t i = 0; i < c.n; ++i) {
      Exact sum, offset;
      for (std::size_t j = 0; j < c.n; ++j)
        offset = offset + Exact(c.inverse[i * c.n + j]) * value[j];
      EXPECT_TRUE(offset.abs() <= Exact(image.offset[i]));
      sum = offset.abs();
      for (std::size_t k = 0; k < c.m; ++k) {
        Exact along;
        for (std::size_t j = 0; j < c.n; ++j) {
          Exact entry = by_variable[j * c.m + k];
          for (std::size_t l = 0; l < c.n; ++l)
            entry = entry + by_unknown[j * c.n + l] * Exact(c.tube.slopes[l * c.m + k]);
          along = along + Exact(c.inverse[i * c.n + j]) * entry;
        }
        EXPECT_TRUE(along.abs() * step[k] <= Exact(image.impact[i * c.m + k]));
        sum = sum + along.abs() * step[k];
      }
      for (std::size_t l = 0; l < c.n; ++l) {
        Exact entry(i == l ? -1.0 : 0.0);
        for (std::size_t j = 0; j < c.n; ++j)
          entry = entry + Exact(c.inverse[i * c.n + j]) * by_unknown[j * c.n + l];
        EXPECT_TRUE(entry.abs() <= Exact(image.spread[i * c.n + l]));
        sum = sum + entry.abs() * Exact(c.tube.radius[l]);
      }
      ASSERT_TRUE(sum <= Exact(image.radius[i])) << round;
    }
  }
}

TEST(ATube, LiesInItsEnclosure) {
  RandomSource random(3);
  for (int round = 0; round < 2000; ++round) {
    const RandomCase c(random);
    const auto unknowns = enclose(c.tube, c.box);
    std::vector<Exact> step;
    for (std::size_t k = 0; k < c.m; ++k)
      step.push_back(member(random, c.box[k]) - Exact(c.tube.at[k]));
    for (std::size_t i = 0; i < c.n; ++i) {
      Exact p = Exact(c.tube.center[i]) + member(random, {-c.tube.radius[i], c.tube.radius[i]});
      for (std::size_t k = 0; k < c.m; ++k) p = p + Exact(c.tube.slopes[i * c.m + k]) * step[k];
      ASSERT_TRUE(holds(unknowns[i], p)) << round;
    }
  }
}

/// p = x: one unknown, one variable.
bool is_one(const BranchTube& tube, const Interval& box, const Interval& value,
            const Interval& by_unknown, const Interval& by_variable, double inverse = 1) {
  const TubeImage image =
      image_of(tube, {&box, 1}, {&inverse, 1}, {{&value, 1}, {&by_unknown, 1}, {&by_variable, 1}});
  return has_one_solution(tube, image);
}

TEST(TheTestOfATube, HoldsForASolutionAndNotAtTheEdge) {
  const BranchTube tube{{0}, {0}, {1}, {0.5}};
  EXPECT_TRUE(is_one(tube, {-1, 1}, 0.0, 1.0, -1.0));
  EXPECT_TRUE(is_one(tube, {-1, 1}, 0.25, 1.0, -1.0));
  // The solution is at the edge of the tube.
  EXPECT_FALSE(is_one(tube, {-1, 1}, 0.5, 1.0, -1.0));
  // x₀ lies outside the box, so far that the slope of 0 in the place of 1 leads out of the tube.
  const BranchTube level{{0}, {0}, {0}, {0.5}};
  EXPECT_TRUE(is_one(level, {0.25, 0.4375}, 0.0, 1.0, -1.0));
  EXPECT_FALSE(is_one(level, {0.25, 0.5}, 0.0, 1.0, -1.0));
  EXPECT_FALSE(is_one(level, {-0.5, -0.25}, 0.0, 1.0, -1.0));
}

TEST(TheTestOfATube, DoesNotHoldForWhatIsNoTube) {
  const Interval box(-1, 1);
  for (const double radius : {0.0, -0.5, kInfinity, kNaN})
    EXPECT_FALSE(is_one({{0}, {0}, {1}, {radius}}, box, 0.0, 1.0, -1.0)) << radius;
  const BranchTube tube{{0}, {0}, {1}, {0.5}};
  EXPECT_FALSE(is_one(tube, box, kEntire, 1.0, -1.0));
  EXPECT_FALSE(is_one(tube, box, 0.0, kEntire, -1.0));
  EXPECT_FALSE(is_one(tube, box, 0.0, 1.0, kEntire));
  // A singular K, or a singular system.
  EXPECT_FALSE(is_one(tube, box, 0.0, 1.0, -1.0, 0));
  EXPECT_FALSE(is_one(tube, box, 0.0, 0.0, 0.0));
  // A derivative without a bound does not matter only where the variable has one value, that of x₀.
  EXPECT_TRUE(is_one({{0}, {0}, {0}, {0.5}}, 0.0, 0.0, 1.0, kEntire));
  EXPECT_FALSE(is_one({{0}, {0}, {0}, {0.5}}, {0, 0x1p-1074}, 0.0, 1.0, kEntire));
  EXPECT_FALSE(has_one_solution({}, image_of({}, {}, {}, {})));
}

TEST(TheTestOfATube, IsThatOfABoxIfThereAreNoVariables) {
  const BranchTube tube{{}, {1}, {}, {0.25}};
  const double inverse = 0.5;
  // p² = 1.1, p² = 2 and p² = −1 near p = 1.
  for (const auto& [square, expected] : {std::pair{1.1, true}, {2.0, false}, {-1.0, false}}) {
    const Interval value = Interval(1.0) - Interval(square), by_unknown(1.5, 2.5);
    const TubeImage image = image_of(tube, {}, {&inverse, 1}, {{&value, 1}, {&by_unknown, 1}, {}});
    EXPECT_EQ(has_one_solution(tube, image), expected) << square;
  }
}

TEST(AnApproximateInverse, IsFoundOrNot) {
  const auto inverse = approx_inverse_of(std::vector<double>{0, 2, 4, 0}, 2);
  ASSERT_TRUE(inverse);
  EXPECT_EQ(*inverse, (std::vector<double>{0, 0.25, 0.5, 0}));
  EXPECT_FALSE(approx_inverse_of(std::vector<double>{1, 2, 2, 4}, 2));
  EXPECT_FALSE(approx_inverse_of(std::vector<double>{kNaN}, 1));
  EXPECT_FALSE(approx_inverse_of(std::vector<double>{1, kInfinity, 0, 1}, 2));
  EXPECT_FALSE(approx_inverse_of(std::vector<double>{0x1p-1074}, 1));
}

}  // namespace
}  // namespace regulus::detail::test
