// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/regularity/determinant.hpp"

#include <gtest/gtest.h>

#include "runtime/regularity/rohn.hpp"
#include "tests/support/lane_arrays.hpp"

namespace regulus {
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
}  // namespace regulus
