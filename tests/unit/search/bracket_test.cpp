// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the choice of values, with searches whose outcome and cost are given by a formula.
#include "runtime/search/bracket.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace regulus::detail::test {
namespace {

Attempt certified(double value, double seconds = 0.01, std::uint64_t boxes = 1) {
  return {value, Verdict::kNoSingularity, Reason::kAllBoxesCertified, boxes, seconds};
}

Attempt failed(double value, Reason reason, double seconds = 0.01) {
  return {value, Verdict::kPossibleProblem, reason, 1, seconds};
}

Attempt refuted(double value) {
  return {value, Verdict::kSingularity, Reason::kOppositeSigns, 1, 0.01};
}

/// Runs the plan to its end; a search near a ceiling costs as much as a real one.
struct Pursuit {
  std::vector<Attempt> attempts;
  double seconds = 0;

  void of(Bracket& bracket, const std::function<Attempt(const PlannedAttempt&)>& search) {
    while (const auto planned = bracket.next()) {
      ASSERT_LT(attempts.size(), 200U);
      attempts.push_back(search(*planned));
      seconds += attempts.back().seconds;
      bracket.note(attempts.back());
    }
  }
};

std::function<Attempt(const PlannedAttempt&)> ceiling(double at, double price) {
  return [=](const PlannedAttempt& planned) {
    if (planned.value >= at) return failed(planned.value, Reason::kUncertainty, 0.1);
    const double boxes = 1 + price * std::pow(at / (at - planned.value), 2);
    const double seconds = 1e-3 * boxes;
    if (seconds > planned.seconds)
      return failed(planned.value, Reason::kTimeBudget, planned.seconds);
    return certified(planned.value, seconds, std::uint64_t(boxes));
  };
}

TEST(Bracket, StartsAtTheLowerEndAndThenTheUpper) {
  Bracket bracket(1, 2, {});
  EXPECT_EQ(bracket.next()->value, 1);
  bracket.note(certified(1));
  EXPECT_EQ(bracket.next()->value, 2);
  bracket.note(certified(2));
  EXPECT_TRUE(bracket.closed());
  EXPECT_FALSE(bracket.next());
}

TEST(Bracket, SkipsTheUpperEndOnceAWitnessIsBelowIt) {
  Bracket bracket(0, 2, {});
  bracket.note_refuted(1);
  bracket.note(certified(0));
  EXPECT_EQ(bracket.next()->value, 0.5);
}

TEST(Bracket, ClosesOnACriticalValueToTheGapAsked) {
  for (const double critical : {0.4999, 0.001234, 0.77}) {
    Bracket bracket(0, 1, {.gap = 1e-3, .seconds = 1e9});
    Pursuit run;
    run.of(bracket, [=](const PlannedAttempt& planned) {
      return planned.value < critical ? certified(planned.value) : refuted(planned.value);
    });
    EXPECT_TRUE(bracket.closed());
    EXPECT_LT(*bracket.certified(), critical);
    EXPECT_GE(*bracket.refuted(), critical);
    EXPECT_LE(*bracket.gap(), 1e-3);
  }
}

TEST(Bracket, EndsWhenTheLowerEndIsRefutedOrCannotBeCertified) {
  Bracket bad(1, 2, {});
  bad.note(refuted(1));
  EXPECT_TRUE(bad.closed());
  EXPECT_FALSE(bad.next());
  Bracket unknown(1, 2, {});
  unknown.note(failed(1, Reason::kUncertainty));
  EXPECT_FALSE(unknown.closed());
  EXPECT_FALSE(unknown.next());
}

TEST(Bracket, GoesUpWithoutAnUpperEnd) {
  Bracket bracket(0, kInfinity, {});
  Pursuit run;
  run.of(bracket, [](const PlannedAttempt& planned) {
    return planned.value < 300 ? certified(planned.value) : refuted(planned.value);
  });
  EXPECT_TRUE(bracket.closed());
  EXPECT_GE(*bracket.certified(), 297);
}

TEST(Bracket, ComesNearACeilingThatNoSearchPasses) {
  Bracket bracket(0, 1, {.gap = 0.01, .seconds = 60});
  bracket.note_refuted(0.8);
  Pursuit run;
  run.of(bracket, ceiling(0.7, 1));
  EXPECT_FALSE(bracket.closed());
  EXPECT_GT(*bracket.certified(), 0.69);
  EXPECT_LE(run.seconds, 60);
}

TEST(Bracket, SpendsItsTimeOnValuesItCanAfford) {
  Bracket bracket(0, 1, {.gap = 1e-4, .seconds = 60});
  bracket.note_refuted(0.5);
  Pursuit run;
  run.of(bracket, ceiling(0.5, 10));
  // 60 s allow 60 000 boxes, so 0.4935 is certified at once.
  EXPECT_GT(*bracket.certified(), 0.486);
  double wasted = 0;
  for (const Attempt& attempt : run.attempts)
    if (attempt.verdict != Verdict::kNoSingularity) wasted += attempt.seconds;
  EXPECT_LT(wasted, 30);
}

TEST(Bracket, TriesAgainWhatFailedForWantOfBoxesOnlyWithManyMore) {
  Bracket bracket(0, 1, {.gap = 0.01, .seconds = 100});
  bracket.note(certified(0, 0.01, 10000));
  const PlannedAttempt first = *bracket.next();
  EXPECT_EQ(first.value, 1);
  bracket.note({1, Verdict::kPossibleProblem, Reason::kBoxBudget, 9, 1, first.boxes});
  EXPECT_EQ(bracket.next()->value, 0.5);
  bracket.note(certified(0.5, 0.01, 20000));
  EXPECT_LT(bracket.next()->value, 1);
  bracket.note(certified(0.7, 0.01, 30000));
  const PlannedAttempt again = *bracket.next();
  EXPECT_EQ(again.value, 1);
  EXPECT_GT(again.boxes, 2 * first.boxes);
  bracket.note({1, Verdict::kPossibleProblem, Reason::kBoxBudget, 9, 1, again.boxes});
  EXPECT_LT(bracket.next()->value, 1);
}

TEST(Bracket, TriesNothingAgainThatReachedTheBoxesOfEverySearch) {
  Bracket bracket(0, 1, {.gap = 1e-3, .boxes = 100});
  Pursuit run;
  run.of(bracket, [](const PlannedAttempt& planned) {
    EXPECT_LE(planned.boxes, 100U);
    if (planned.value < 0.3) return certified(planned.value, 0.01, 50);
    return Attempt{planned.value, Verdict::kPossibleProblem, Reason::kBoxBudget, 100, 0.01,
                   planned.boxes};
  });
  EXPECT_GT(*bracket.certified(), 0.29);
}

TEST(Bracket, TriesTheSameValuesOnAnyMachine) {
  const auto values_on = [](double seconds_a_box) {
    Bracket bracket(0, 1, {.gap = 1e-3});
    bracket.note_refuted(0.5001);
    Pursuit run;
    run.of(bracket, [=](const PlannedAttempt& planned) {
      Attempt attempt = ceiling(0.5, 3)(planned);
      attempt.seconds = seconds_a_box * double(attempt.boxes);
      attempt.most_boxes = planned.boxes;
      return attempt;
    });
    std::vector<double> values;
    for (const Attempt& attempt : run.attempts) values.push_back(attempt.value);
    return values;
  };
  EXPECT_GT(values_on(1e-9).size(), 5U);
  EXPECT_EQ(values_on(1e-9), values_on(100));
}

/// No value from 10 on is certified, and from 13 on a search finds a witness.
TEST(Bracket, LowersTheRefutedValueAboveOnesThatAreNotDecided) {
  Bracket bracket(0, 100, {.gap = 0.01, .seconds = 1e3});
  bracket.note_refuted(20);
  Pursuit().of(bracket, ceiling(10, 0.01));
  int searches = 0;
  for (; const auto planned = bracket.next_to_refute(); ++searches)
    bracket.note(planned->value >= 13 ? refuted(planned->value)
                                      : failed(planned->value, Reason::kUncertainty));
  EXPECT_NEAR(*bracket.refuted(), 13, 0.05);
  EXPECT_GE(*bracket.refuted(), 13);
  EXPECT_LT(*bracket.certified(), 10);
  EXPECT_LT(searches, 16);
}

TEST(Bracket, EndsWhenTimeIsUp) {
  Bracket bracket(0, 1, {.gap = 0.01, .seconds = 10});
  bracket.note(certified(0, 4));
  EXPECT_TRUE(bracket.next());
  bracket.spend(6);
  EXPECT_FALSE(bracket.next());
}

TEST(ShortDecimal, IsShortAndStrictlyBetween) {
  EXPECT_EQ(short_decimal_near(0.3333333, 0, 1), 0.33);
  EXPECT_EQ(short_decimal_near(0.1219531, 0.1215, 0.1224), 0.12195);
  const double lo = 1.0, hi = std::nextafter(std::nextafter(1.0, 2), 2);
  const double between = short_decimal_near(std::nextafter(1.0, 2), lo, hi);
  EXPECT_TRUE(lo < between && between < hi);
}

TEST(ShortDecimal, AboveIsNeverBelowAndNotFarAbove) {
  for (double x = 1.00001e-7; x < 1e9; x *= 1.00137) {
    const double above = short_decimal_above(x);
    EXPECT_GE(above, x);
    EXPECT_LE(above, x * (1 + 1.2e-4));
  }
  EXPECT_EQ(short_decimal_above(0.134122), 0.13413);
  EXPECT_EQ(short_decimal_above(0), 0);
}

}  // namespace
}  // namespace regulus::detail::test
