// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/embedded/checker.hpp"

#include <gtest/gtest.h>
#include <malloc.h>

#include <cfenv>
#include <cmath>
#include <limits>

#include "counted_calls.hpp"
#include "runtime/embedded/checker.h"
#include "runtime/interval/floating_point_scope.hpp"
#include "runtime/search/solver.hpp"
#include "static_kernel.hpp"
#include "tests/support/exact.hpp"
#include "tests/support/gough_kernel.hpp"

namespace regulus::detail {
namespace {

using Piece = std::vector<Interval>;

class Embedded : public testing::Test {
 protected:
  const double r_ = 0.5;
  const regulus_kernel point_ = test::static_kernel(test::point_matrix, 2, &r_);
  const regulus_kernel line_ = test::static_kernel(test::line_matrix, 1, &r_);
  const Piece ranges_ = {{-1, 1}, {-1, 1}, {-0.0625, 0.0625}};
};

TEST_F(Embedded, ACheckDecidesAsTheSearchDoes) {
  Checker checker(point_, ranges_, 1000);
  const Piece pieces[] = {{{-1, 0.25}, {-1, 1}},       {{-1, 1}, {0.25, 1}},
                          {{0.5625, 1}, {0x1p-20, 1}}, {{0, 1}, {-1, 1}},
                          {{0.45, 0.46}, {0, 0.1}},    {{-1, -1}, {0, 0}}};
  for (const Piece& piece : pieces) {
    const Check check = checker.check(piece);
    Problem problem;
    problem.kernel = &point_;
    problem.outer = {piece[0], piece[1], ranges_[2]};
    problem.inner.assign(problem.outer.begin(), problem.outer.end());
    EXPECT_EQ(check.verdict, solve(problem, {}).verdict) << piece[0].lo << ' ' << piece[0].hi;
  }
}

/// The whole ranges have shown how to split, and eight boxes take the time of one.
TEST_F(Embedded, APlatformTakesNoMoreBoxesThanTheSearch) {
  for (const auto& [robot, side, z, degrees] :
       {std::tuple{test::kRobot1, 15.0, Interval(45, 50), 15.0},
        {test::kRobot1, 15.0, Interval(45, 50), 40.0},
        {test::kRobot2, 200.0, Interval(2800, 3200), 20.0},
        {test::kRobot2, 200.0, Interval(2800, 3200), 30.0},
        {test::kRobot2, 200.0, Interval(2800, 3200), 40.0}}) {
    const test::GoughKernel kernel(robot);
    const Interval angle = test::plus_minus_degrees(degrees).outer, xy(-side, side);
    Problem problem;
    problem.kernel = kernel.get();
    problem.outer = {xy, xy, z, angle, angle, angle};
    problem.inner.assign(problem.outer.begin(), problem.outer.end());
    const Result result = solve(problem, {});
    const Check check = Checker(*kernel.get(), problem.outer, 1000).check(problem.outer);
    EXPECT_EQ(check.verdict, result.verdict) << degrees;
    // The search looks at corners after its first box, the check after its first batch.
    EXPECT_LE(check.boxes, std::max<std::uint64_t>(result.statistics.boxes, 8)) << degrees;
  }
}

/// Room for every box of the limit would be 50 MB here, and more for more variables.
TEST_F(Embedded, ReservesRoomForBoxesThatMayWaitTogether) {
  const auto allocated = [] {
    const struct mallinfo2 info = ::mallinfo2();
    return info.uordblks + info.hblkhd;
  };
  const std::size_t before = allocated();
  const Checker checker(point_, ranges_, Checker::kMaxBoxes);
  EXPECT_LT(allocated(), before + (std::size_t{1} << 20));
}

TEST_F(Embedded, ASingularityIsProvedByPointsOfThePiece) {
  Checker checker(line_, ranges_, 1000);
  const Piece piece = {{-0.75, 0.5}, {0, 1}};
  const Check check = checker.check(piece);
  ASSERT_EQ(check.verdict, Verdict::kSingularity);
  EXPECT_EQ(check.reason, Reason::kOppositeSigns);
  ASSERT_EQ(check.places.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_TRUE(certain_subset(check.places[k], k % 3 < 2 ? piece[k % 3] : ranges_[2]));
  EXPECT_GT(check.places[0].lo + check.places[2].lo, 0.0);
  EXPECT_LT(check.places[3].hi + check.places[5].hi, 0.0);
}

TEST_F(Embedded, AWitnessSpeaksOfAllValuesThatAPointInABallCouldHave) {
  const int ball[] = {-1, -1, 0}, row[] = {-1, -1, -1};
  regulus_expansion expansion{};
  expansion.row_of_variable = row;
  expansion.ball_of_variable = ball;
  expansion.product = [](const double*, const double*, double*, const void*) { return 255U; };
  regulus_kernel kernel = line_;
  kernel.expansion = &expansion;
  Checker checker(kernel, ranges_, 1000);
  const Check check = checker.check(Piece{{-0.75, 0.5}, {0, 1}});
  ASSERT_EQ(check.verdict, Verdict::kSingularity);
  for (const std::size_t u : {2U, 5U}) EXPECT_TRUE(certain_subset(ranges_[2], check.places[u]));
}

TEST_F(Embedded, AThresholdIsHeldOrAPointBelowItIsShown) {
  Checker checker(line_, ranges_, 1000, 0.25);
  const Check safe = checker.check(Piece{{0.375, 1}, {0, 1}});
  EXPECT_EQ(safe.verdict, Verdict::kNoSingularity) << describe(safe.reason);
  const Check small = checker.check(Piece{{0.0, 0.25}, {0, 1}});
  EXPECT_EQ(small.verdict, Verdict::kSingularity);
  EXPECT_EQ(small.reason, Reason::kSmallDeterminant);
  EXPECT_EQ(small.places.size(), 3U);
}

TEST_F(Embedded, NoMoreBoxesAreEvaluatedThanAllowed) {
  const Piece piece = {{0.65, 1}, {-1, 1}};
  const unsigned whole = Checker(point_, ranges_, 100000).check(piece).boxes;
  ASSERT_GT(whole, 20U);
  for (unsigned most = 1; most < whole; ++most) {
    Checker checker(point_, ranges_, most);
    const Check check = checker.check(piece);
    EXPECT_EQ(check.verdict, Verdict::kPossibleProblem);
    EXPECT_EQ(check.reason, Reason::kBoxBudget);
    EXPECT_EQ(check.boxes, most);
    ASSERT_EQ(check.places.size(), 3U);
    EXPECT_TRUE(certain_subset(check.places[0], piece[0]));
  }
  EXPECT_EQ(Checker(point_, ranges_, whole).check(piece).verdict, Verdict::kNoSingularity);
}

TEST_F(Embedded, ACheckRemembersNothingOfThoseBefore) {
  Checker used(point_, ranges_, 500);
  const Piece pieces[] = {{{0.65, 1}, {-1, 1}}, {{0, 1}, {-1, 1}}, {{-1, 0.4}, {0, 1}}};
  for (int round = 0; round < 3; ++round)
    for (const Piece& piece : pieces) {
      const Check again = used.check(piece);
      Checker fresh(point_, ranges_, 500);
      const Check first = fresh.check(piece);
      EXPECT_EQ(again.verdict, first.verdict);
      EXPECT_EQ(again.boxes, first.boxes);
      EXPECT_TRUE(std::equal(again.places.begin(), again.places.end(), first.places.begin(),
                             first.places.end()));
    }
}

TEST_F(Embedded, PiecesThatDoNotFitAreRefused) {
  Checker checker(point_, ranges_, 100);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  Piece reversed = {{0, 0.25}, {0, 1}}, unknown = reversed;
  reversed[0].lo = 0.3;
  unknown[1].hi = kNaN;
  for (const Piece& piece : {Piece{{-2, 0}, {0, 1}}, Piece{{0, 1}}, Piece{}, reversed, unknown,
                             Piece{{0, 1}, {0, 1}, {0, 0}}}) {
    const Check check = checker.check(piece);
    EXPECT_EQ(check.verdict, Verdict::kPossibleProblem);
    EXPECT_EQ(check.reason, Reason::kBadProblem);
    EXPECT_TRUE(check.places.empty());
  }
}

TEST_F(Embedded, APieceThatTheConstraintsExcludeIsNoClaim) {
  regulus_kernel kernel = point_;
  kernel.constraints = 1;
  // The first motion parameter must be at most -1/2.
  kernel.constraint = [](const double* boxes, const double*, double* out, const void*) {
    for (unsigned lane = 0; lane < REGULUS_LANES; ++lane) {
      out[lane] = boxes[lane] + 0.5;
      out[REGULUS_LANES + lane] = boxes[REGULUS_LANES + lane] + 0.5;
    }
    return 0U;
  };
  Checker checker(kernel, ranges_, 1000);
  const Check nothing = checker.check(Piece{{-0.25, 0.25}, {0, 1}});
  EXPECT_EQ(nothing.verdict, Verdict::kPossibleProblem);
  EXPECT_EQ(nothing.reason, Reason::kEmptyVariety);
  EXPECT_TRUE(nothing.places.empty());
  EXPECT_EQ(checker.check(Piece{{-1, -0.75}, {0.5, 1}}).verdict, Verdict::kNoSingularity);
  EXPECT_EQ(checker.check(Piece{{-0.25, 0.25}, {0, 1}}).reason, Reason::kEmptyVariety);
}

/// The determinant vanishes at one double of a short trajectory; the check must detect it.
TEST_F(Embedded, NoPartOfATrajectoryIsLeftOut) {
  const Piece exact = {{-1, 1}, {-1, 1}, {0, 0}};
  for (const unsigned most : {1U, 2U, 3U, 5U, 7U, 8U, 100U}) {
    Checker checker(line_, exact, most);
    for (int ulps = 1; ulps < 40; ++ulps)
      for (int zero = 0; zero <= ulps; ++zero) {
        const Interval x{-0x1p-60 * zero, 0x1p-60 * (ulps - zero)};
        EXPECT_NE(checker.check(Piece{x, {0, 0}}).verdict, Verdict::kNoSingularity);
      }
    for (const double from : {-1.0, 0x1p-100, 0.3}) {
      double to = from;
      for (int ulps = 0; ulps < 20; ++ulps, to = std::nextafter(to, 2.0)) {
        const Check check = checker.check(Piece{{from, to}, {0, 0}});
        EXPECT_EQ(check.verdict, Verdict::kNoSingularity) << from << ' ' << ulps << ' ' << most;
        EXPECT_LE(check.boxes, most);
      }
    }
  }
}

TEST_F(Embedded, FaultyProblemsAreRefusedWhenTheCheckerIsMade) {
  EXPECT_THROW(Checker(point_, ranges_, 0), std::invalid_argument);
  EXPECT_THROW(Checker(point_, ranges_, Checker::kMaxBoxes + 1), std::invalid_argument);
  EXPECT_THROW(Checker(point_, ranges_, 1, -1.0), std::invalid_argument);
  EXPECT_THROW(Checker(point_, Piece{{0, 1}}, 1), std::invalid_argument);
}

TEST_F(Embedded, AMillionChecksNeitherAllocateNorLock) {
  if (!test::kCallsAreCounted) GTEST_SKIP() << "a sanitizer owns the allocator";
  const double lower[] = {-1, -1, -0.0625}, upper[] = {1, 1, 0.0625};
  regulus_checker* checker = regulus_checker_new(&point_, lower, upper, 0.0, 64, nullptr, 0);
  ASSERT_NE(checker, nullptr);
  const std::uint64_t allocations = test::allocations(), locks = test::locks();
  std::uint64_t verdicts[3] = {};
  regulus_check_report report;
  for (int i = 0; i < 1'000'000; ++i) {
    // Most pieces are decided at once; some take many boxes, and some exceed the limit.
    const double y = 0.25 + 0.0000005 * i;
    const double from[] = {-1.0, i % 1013 == 0 ? -y : y},
                 to[] = {i % 97 == 0 || i % 1013 == 0 ? 1.0 : -0.25, y + 0.25};
    ++verdicts[regulus_check(checker, from, to, &report)];
    ASSERT_LE(report.boxes, 64U);
  }
  EXPECT_EQ(test::allocations(), allocations);
  EXPECT_EQ(test::locks(), locks);
  EXPECT_GT(verdicts[REGULUS_CHECK_NO_SINGULARITY], 900'000U);
  EXPECT_GT(verdicts[REGULUS_CHECK_POSSIBLE_PROBLEM], 100U);
  regulus_checker_free(checker);
}

TEST_F(Embedded, TheCallersFloatingPointEnvironmentIsKept) {
  Checker checker(point_, ranges_, 1000);
  const Piece piece = {{0.65, 1}, {-1, 1}};
  const Check expected = checker.check(piece);
  const auto expect_same = [&expected](const Check& check) {
    EXPECT_EQ(check.verdict, expected.verdict);
    EXPECT_EQ(check.boxes, expected.boxes);
  };
  for (const int mode : {FE_DOWNWARD, FE_UPWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const Check check = checker.check(piece);
    EXPECT_EQ(std::fegetround(), mode);
    std::fesetround(FE_TONEAREST);
    expect_same(check);
  }
#if defined(__x86_64__)
  // A controller may flush subnormals to save time.
  const unsigned usual = read_mxcsr();
  for (const unsigned flushing : {0x8000U, 0x40U, 0x8040U}) {
    write_mxcsr(usual | flushing);
    const Check check = checker.check(piece);
    EXPECT_EQ(read_mxcsr() & 0x8040U, flushing);
    write_mxcsr(usual);
    expect_same(check);
  }
#endif
}

TEST_F(Embedded, TheCInterfaceSaysTheSame) {
  const double lower[] = {-1, -1, -0.0625}, upper[] = {1, 1, 0.0625};
  char fault[16];
  EXPECT_EQ(regulus_checker_new(nullptr, lower, upper, 0.0, 10, fault, sizeof fault), nullptr);
  EXPECT_STREQ(fault, "the kernel or a");
  EXPECT_EQ(regulus_checker_new(&line_, upper, lower, 0.0, 10, nullptr, 0), nullptr);

  regulus_checker* checker =
      regulus_checker_new(&line_, lower, upper, 0.0, 10, fault, sizeof fault);
  ASSERT_NE(checker, nullptr);
  regulus_check_report report;
  const double safe_from[] = {0.25, 0}, safe_to[] = {0.5, 1};
  EXPECT_EQ(regulus_check(checker, safe_from, safe_to, &report), REGULUS_CHECK_NO_SINGULARITY);
  EXPECT_EQ(report.reason, REGULUS_CHECK_ALL_CERTIFIED);
  EXPECT_EQ(report.places, 0U);
  const double singular_from[] = {-0.75, 0}, singular_to[] = {0.5, 1};
  EXPECT_EQ(regulus_check(checker, singular_from, singular_to, &report), REGULUS_CHECK_SINGULARITY);
  ASSERT_EQ(report.places, 2U);
  EXPECT_GT(report.place[0] + report.place[4], 0.0);
  EXPECT_EQ(regulus_check(checker, singular_to, singular_from, nullptr),
            REGULUS_CHECK_POSSIBLE_PROBLEM);
  const double beyond[] = {2, 1};
  EXPECT_EQ(regulus_check(checker, singular_from, beyond, &report), REGULUS_CHECK_POSSIBLE_PROBLEM);
  EXPECT_EQ(report.reason, REGULUS_CHECK_BAD_RANGES);
  regulus_checker_free(checker);
  regulus_checker_free(nullptr);
}

}  // namespace
}  // namespace regulus::detail
