// SPDX-License-Identifier: GPL-3.0-or-later
// Tests a question that is asked again and again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <stdexcept>

#include "codegen/use/api/regulus.hpp"
#include "tests/unit/api/circle.hpp"

namespace {

using regulus::Interval;
using regulus::Question;
using regulus::Verdict;
using regulus::detail::test::circle;
using regulus::detail::test::interpreted;

TEST(PreparedQuestion, AnswersOthersThanItWasPreparedFor) {
  const Question outside(circle(), "outside");
  regulus::PreparedQuestion prepared(outside, interpreted());
  const auto verdict = [&](const Question& asked) { return prepared.check(asked).verdict; };
  EXPECT_EQ(verdict(outside), Verdict::kNoSingularity);
  EXPECT_EQ(verdict(Question(outside).range("x", "0", "3").range("y", "0", "3")),
            Verdict::kSingularity);
  // h becomes a variable, and the row scales are needed: other functions.
  EXPECT_EQ(verdict(Question(outside).tolerance("platform", "1.8")), Verdict::kNoSingularity);
  EXPECT_EQ(verdict(Question(outside).tolerance("platform", "1.83")), Verdict::kSingularity);
  EXPECT_EQ(verdict(Question(outside).alpha("6")), Verdict::kNoSingularity);
  EXPECT_EQ(verdict(Question(outside).alpha("7")), Verdict::kSingularity);
  EXPECT_EQ(verdict(outside), Verdict::kNoSingularity);
  EXPECT_THROW(static_cast<void>(verdict(Question(circle(), "across"))), regulus::UsageError);
}

TEST(PreparedQuestion, DescribesTheFindingAndNotALaterOne) {
  const Question outside(circle(), "outside");
  regulus::PreparedQuestion prepared(outside, interpreted());
  const Question narrow = Question(outside).range("x", "2", "5/2");
  regulus::Finding finding = prepared.check(narrow);
  static_cast<void>(prepared.check(Question(outside).range("x", "2", "4")));
  prepared.describe(narrow, finding);
  EXPECT_THAT(finding.report, testing::HasSubstr("x in [2, 2.5] cm"));
}

/// A part of the changed range must be defined, as a range of the file must be.
TEST(PreparedQuestion, RefusesARangeWithoutAValue) {
  const Question outside(circle(), "outside");
  regulus::PreparedQuestion prepared(outside, interpreted());
  for (const char* undefined : {"2 + 0*(1/0)", "2 + 0*sqrt(-1)", "2 + 0*log(0)"}) {
    Verdict fresh = Verdict::kPossibleProblem, kept = Verdict::kPossibleProblem;
    const Question asked = Question(outside).range("x", undefined, "3");
    try {
      fresh = regulus::check(asked, interpreted()).verdict;
    } catch (const std::runtime_error&) {
    }
    try {
      kept = prepared.check(asked).verdict;
    } catch (const std::runtime_error&) {
    }
    EXPECT_EQ(fresh, kept) << undefined;
    EXPECT_NE(kept, Verdict::kNoSingularity) << undefined;
  }
}

/// The conditions of one range are not those of another, although both have one.
TEST(PreparedQuestion, KeepsTheConditionsOfRangesApart) {
  const Question outside(circle(), "outside");
  regulus::PreparedQuestion prepared(outside, interpreted());
  const auto verdict = [&](const char* low) {
    return prepared.check(Question(outside).range("x", low, "3")).verdict;
  };
  EXPECT_EQ(verdict("2 + 0*sqrt(2)"), Verdict::kNoSingularity);
  EXPECT_ANY_THROW(static_cast<void>(verdict("2 + 0*sqrt(-2)")));
  EXPECT_EQ(verdict("2 + 0*sqrt(3)"), Verdict::kNoSingularity);
}

/// A range without a value leaves the ranges of the search as they were.
TEST(PreparedQuestion, ForgetsNoRangeAfterAnError) {
  const Question outside(circle(), "outside");
  regulus::PreparedQuestion prepared(outside, interpreted());
  const Question wide = Question(outside).range("x", "0", "3").range("y", "0", "3");
  for (int round = 0; round < 3; ++round) {
    EXPECT_EQ(prepared.check(wide).verdict, Verdict::kSingularity);
    EXPECT_ANY_THROW(static_cast<void>(
        prepared.check(Question(outside).range("x", "2", "exp(10000)").range("y", "2", "3"))));
    EXPECT_EQ(prepared.check(outside).verdict, Verdict::kNoSingularity);
  }
}

/// Whether the ranges hold a pose on the circle of radius 1, in multiples of 1/8.
bool meets_circle(const std::vector<Interval>& ranges) {
  double nearest = 0, farthest = 0;
  for (const Interval& x : ranges) {
    const double near = std::max({0.0, x.lo, -x.hi}), far = std::max(-x.lo, x.hi);
    nearest += near * near, farthest += far * far;
  }
  return nearest <= 1 && 1 <= farthest;
}

TEST(PreparedQuestion, TakesRangesOfDoubles) {
  const Question outside(circle(), "outside");
  regulus::PreparedQuestion prepared(outside, interpreted());
  ASSERT_EQ(prepared.parameters(), (std::vector<std::string>{"x", "y"}));
  std::mt19937 random(3);
  std::uniform_int_distribution<int> eighths(-16, 16);
  int singular = 0;
  for (int step = 0; step < 300; ++step) {
    std::vector<Interval> ranges;
    for (int k = 0; k < 2; ++k) {
      const auto [lo, hi] = std::minmax({eighths(random), eighths(random)});
      ranges.emplace_back(lo / 8.0, hi / 8.0);
    }
    const bool meets = meets_circle(ranges);
    singular += meets ? 1 : 0;
    EXPECT_EQ(prepared.check(ranges).verdict,
              meets ? Verdict::kSingularity : Verdict::kNoSingularity)
        << ranges[0].lo << ' ' << ranges[0].hi << ' ' << ranges[1].lo << ' ' << ranges[1].hi;
    if (step % 10 == 0) {
      EXPECT_EQ(prepared.check(outside).verdict, Verdict::kNoSingularity);
    }
  }
  EXPECT_GT(singular, 50);
  EXPECT_LT(singular, 250);
}

/// Tolerances and threshold are those of the question that was prepared, whatever was asked since.
TEST(PreparedQuestion, AsksRangesOfDoublesAsItWasPrepared) {
  const Question outside = Question(circle(), "outside").tolerance("platform", "1/2").alpha("2");
  regulus::PreparedQuestion prepared(outside, interpreted());
  const std::vector<Interval> far = {{2, 3}, {0, 1}}, near = {{1.75, 3}, {0, 1}};
  const auto verdict = [&](const auto& asked) { return prepared.check(asked).verdict; };
  // The determinant's least value is 4 − 9/4.
  EXPECT_EQ(verdict(far), Verdict::kSingularity);
  EXPECT_EQ(verdict(Question(outside).tolerance("platform", "1/4").range("x", "2", "3")),
            Verdict::kNoSingularity);
  EXPECT_EQ(verdict(far), Verdict::kSingularity);
  EXPECT_EQ(verdict(std::vector<Interval>{{2.25, 3}, {0, 1}}), Verdict::kNoSingularity);
  EXPECT_EQ(verdict(Question(circle(), "outside").range("x", "3/2", "3").range("y", "0", "1")),
            Verdict::kNoSingularity);
  EXPECT_EQ(verdict(near), Verdict::kSingularity);
}

TEST(PreparedQuestion, RefusesRangesThatAreNone) {
  const double infinite = std::numeric_limits<double>::infinity(),
               none = std::numeric_limits<double>::quiet_NaN();
  regulus::PreparedQuestion prepared(Question(circle(), "outside"), interpreted());
  for (const std::vector<Interval>& wrong : {std::vector<Interval>{},
                                             {{2, 3}},
                                             {{2, 3}, {2, 3}, {2, 3}},
                                             {{2, 3}, {none, 3}},
                                             {{2, 3}, {3, 2}},
                                             {{2, infinite}, {2, 3}}})
    EXPECT_THROW(static_cast<void>(prepared.check(wrong)), regulus::UsageError);
  EXPECT_EQ(prepared.check(std::vector<Interval>{{2, 3}, {2, 3}}).verdict, Verdict::kNoSingularity);
}

TEST(PreparedQuestion, KeepsRangesOfDoublesWithinTheLimitsOfJoints) {
  const Question arm = Question::of_text(
      "regulus = 1\nname = \"arm\"\n[serial]\njoints = [\n"
      "  { name = \"a\", type = \"revolute\" },\n"
      "  { name = \"b\", type = \"revolute\", xyz = [1, 0, 0], axis = [0, 1, 0] },\n"
      "]\n[motion.limits]\na = [-1, 1]\nb = [0.5, 1]\n[motion.part]\na = [0, 1]\nb = [0.5, 1]\n",
      "arm.toml", "part");
  regulus::PreparedQuestion prepared(arm, interpreted());
  static_cast<void>(prepared.check(std::vector<Interval>{{-1, 1}, {0.5, 1}}));
  EXPECT_THROW(static_cast<void>(prepared.check(std::vector<Interval>{{-1, 1.0000001}, {0.5, 1}})),
               regulus::InputError);
}

}  // namespace
