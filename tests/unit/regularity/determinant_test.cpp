// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/regularity/determinant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "runtime/regularity/rohn.hpp"
#include "runtime/regularity/upward_elimination.hpp"
#include "tests/support/lane_arrays.hpp"

namespace regulus::detail {
namespace {

LaneMatrix matrix(std::size_t n, const std::vector<Interval>& entries) {
  LaneMatrix M;
  M.n = n;
  std::copy(entries.begin(), entries.end(), M.entries.begin());
  return M;
}

TEST(Determinant, IsExactOnSmallIntegers) {
  const LaneMatrix M = matrix(3, {2.0, 0.0, 1.0, 1.0, 3.0, 2.0, 1.0, 1.0, 1.0});
  EXPECT_EQ(enclose_determinant(M), Interval(0.0));
  const LaneMatrix regular = matrix(3, {2.0, 0.0, 1.0, 1.0, 3.0, 2.0, 1.0, 1.0, 4.0});
  EXPECT_EQ(enclose_determinant(regular), Interval(18.0));
  EXPECT_TRUE(contains(enclose_determinant_by_elimination(regular), 18.0));
}

TEST(Determinant, OfOneEntryIsTheEntry) {
  EXPECT_EQ(enclose_determinant(matrix(1, {{-1, 2}})), Interval(-1, 2));
  EXPECT_EQ(enclose_determinant_by_elimination(matrix(1, {{-1, 2}})), Interval(-1, 2));
}

TEST(Determinant, EliminationExchangesRowsAndKeepsTheSign) {
  const Interval determinant = enclose_determinant_by_elimination(matrix(2, {0.0, 2.0, 3.0, 1.0}));
  EXPECT_TRUE(contains(determinant, -6.0));
  EXPECT_EQ(certain_sign(determinant), -1);
}

TEST(Determinant, EliminationExpandsWhatHasNoPivot) {
  // Every entry contains 0: only expansion gives a bound.
  const Interval x(-1, 1);
  const Interval determinant = enclose_determinant_by_elimination(matrix(2, {x, x, x, x}));
  EXPECT_EQ(determinant, Interval(-2, 2));
}

TEST(Determinant, EliminationOfManyRowsWithoutPivotIsTheWholeLine) {
  LaneMatrix M;
  M.n = kMaxExpansion + 1;
  M.entries.fill(Interval(-1, 1));
  EXPECT_EQ(enclose_determinant_by_elimination(M), kEntire);
}

/// Elimination in the arithmetic of Interval; nullopt if a pivot before the last one contains 0.
std::optional<Interval> eliminate_by_intervals(LaneMatrix M) {
  Interval product(1.0);
  for (std::size_t k = 0; k < M.n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < M.n; ++i)
      if (mig(M.at(i, k)) > mig(M.at(pivot, k))) pivot = i;
    if (k + 1 < M.n && mig(M.at(pivot, k)) == 0.0) return std::nullopt;
    for (std::size_t j = 0; j < M.n && pivot != k; ++j) std::swap(M.at(pivot, j), M.at(k, j));
    if (pivot != k) product = -product;
    product = product * M.at(k, k);
    for (std::size_t i = k + 1; i < M.n; ++i) {
      const Interval factor = M.at(i, k) / M.at(k, k);
      for (std::size_t j = k + 1; j < M.n; ++j) M.at(i, j) = M.at(i, j) - factor * M.at(k, j);
    }
  }
  return product;
}

TEST(Determinant, TheRoundingOfTheProcessorGivesTheBoundsOfIntervals) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  int bounded = 0;
  for (int round = 0; round < 20'000; ++round) {
    LaneMatrix M;
    M.n = 1 + random() % 8;
    const double width =
        random() % 3 == 0 ? 0.0 : std::ldexp(1.0, -static_cast<int>(random() % 60));
    const double size = std::ldexp(1.0, static_cast<int>(random() % 60) - 30);
    for (std::size_t e = 0; e < M.n * M.n; ++e) {
      const double x = random() % 5 == 0 ? 0.0 : size * value(random);
      M.entries[e] = Interval(x, x + size * width * std::fabs(value(random)));
    }
    const std::optional<Interval> expected = eliminate_by_intervals(M);
    const std::optional<Interval> actual = enclose_determinant_upward(M);
    ASSERT_EQ(actual.has_value(), expected.has_value()) << round;
    if (!expected) continue;
    ++bounded;
    ASSERT_EQ(*actual, *expected) << round;
  }
  EXPECT_GT(bounded, 5000);
}

TEST(Determinant, TheRoundingOfTheProcessorBoundsNoInfinity) {
  const LaneMatrix huge = matrix(2, {1e300, 1.0, 1.0, 1e300});
  EXPECT_EQ(enclose_determinant_upward(huge), std::nullopt);
  EXPECT_EQ(enclose_determinant_upward(matrix(1, {{1.0, HUGE_VAL}})), std::nullopt);
  EXPECT_EQ(certain_sign(enclose_determinant_by_elimination(huge)), 1);
}

TEST(Determinant, ExpansionFollowsTheNarrowestLine) {
  // Along the thin first column: [1, 1]·d − 0·b = [2, 3]; the second row 0, d gives the same.
  EXPECT_EQ(enclose_determinant(matrix(2, {1.0, {-9, 9}, 0.0, {2, 3}})), Interval(2, 3));
  // 3×3: the thin row (1, 0, 0) leaves the minor alone.
  EXPECT_EQ(enclose_determinant(matrix(3, {{-5, 5}, 2.0, 1.0, 1.0, 0.0, 0.0, {-7, 7}, 1.0, 1.0})),
            Interval(-1.0));
}

TEST(Determinant, SignIsCertainOnlyAwayFromZero) {
  EXPECT_EQ(certain_sign({0.5, 1}), 1);
  EXPECT_EQ(certain_sign({-1, -0.5}), -1);
  EXPECT_EQ(certain_sign({0, 1}), 0);
  EXPECT_EQ(certain_sign(kEntire), 0);
}

std::vector<double> same_lanes(const std::vector<Interval>& entries) {
  std::vector<double> x(2 * entries.size() * kLanes);
  for (std::size_t e = 0; e < entries.size(); ++e)
    for (std::size_t l = 0; l < kLanes; ++l) {
      x[lower_at(e, l)] = entries[e].lo;
      x[upper_at(e, l)] = entries[e].hi;
    }
  return x;
}

LaneMask rohn(std::size_t n, const std::vector<Interval>& entries) {
  return certain_rohn(test::intervals(same_lanes(entries), n), kAllLanes);
}

TEST(Rohn, CertifiesRegularIntervalMatrices) {
  EXPECT_EQ(rohn(1, {{0.5, 2}}), kAllLanes);
  EXPECT_EQ(rohn(2, {{1, 2}, {-0.5, 0.5}, {-0.5, 0.5}, {1, 2}}), kAllLanes);
  const Interval d(2, 3), o(-0.9, 0.9);
  EXPECT_EQ(rohn(3, {d, o, o, o, d, o, o, o, d}), kAllLanes);
}

TEST(Rohn, NeedsNoDominantDiagonal) {
  const std::vector<Interval> entries{{1, 2}, {0.5, 3}, {-3, -0.1}, {1, 2}};
  EXPECT_EQ(rohn(2, entries), kAllLanes);
}

TEST(Rohn, RefusesIntervalMatricesWithASingularMember) {
  EXPECT_EQ(rohn(1, {{-1, 2}}), 0U);
  EXPECT_EQ(rohn(1, {{0, 2}}), 0U);
  EXPECT_EQ(rohn(2, {{1, 2}, {-1, 1}, {-1, 1}, {1, 2}}), 0U);
  const Interval d(2, 3), o(-1, 1);
  EXPECT_EQ(rohn(3, {d, o, o, o, d, o, o, o, d}), 0U);
}

TEST(Rohn, LooksOnlyAtTheLanesAsked) {
  EXPECT_EQ(certain_rohn(test::intervals(same_lanes({{1, 2}}), 1), 0b101U), 0b101U);
}

TEST(Rohn, RefusesWhatIsTooLarge) {
  std::vector<Interval> identity((kMaxRohn + 1) * (kMaxRohn + 1), Interval(0.0));
  for (std::size_t i = 0; i <= kMaxRohn; ++i) identity[i * (kMaxRohn + 2)] = 1.0;
  EXPECT_EQ(rohn(kMaxRohn + 1, identity), 0U);
}

}  // namespace
}  // namespace regulus::detail
