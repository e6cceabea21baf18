// SPDX-License-Identifier: GPL-3.0-or-later
// A search of a condition number that is stopped and continued, from true states and from others.
#include <cmath>
#include <random>
#include <regex>

#include "tests/support/damage.hpp"
#include "tests/unit/bound/condition_matrix.hpp"

namespace regulus::detail::test {
namespace {

/// Undefined near x = 0, so no box there has a bound.
std::string undefined_at_an_end() {
  std::string text = kTurned;
  const std::string first = "cos(x)*cos(y)";
  return text.replace(text.find(first), first.size(), first + " + sqrt(x)/10^20");
}

/// Small boxes at the corner (2, 10) have bounds that differ by roundings, in either direction.
constexpr const char* kSheared = R"toml(regulus = 1
name = "shear"
[pose]
x = "1"
y = "1"
[matrix]
rows = [["x/3", "y/7 + x*x/9"], [0, "y"]]
[motion.m]
x = [1, 2]
y = [3, 10]
)toml";

TEST(ContinuedConditionSearch, EndsLikeOneWithoutAStop) {
  for (const auto& [method, entries] :
       {std::pair{Method::kReg, Entries::kDerivatives}, {Method::kAuto, Entries::kNatural}}) {
    const TestMatrix matrix(kTurned, method, entries);
    const ConditionSettings settings = settings_with_gap(0.06);
    const Ended whole = matrix.run(settings);
    ASSERT_TRUE(whole.result.is_closed);
    ASSERT_GT(whole.result.boxes, 1000U);
    EXPECT_GE(whole.result.proved, kTurnedCondition);
    expect_same(run_with_stops(matrix, settings, {1}), whole);
    expect_same(run_with_stops(matrix, settings, {2, 3, 70, 71, 300, 800}), whole);
    expect_same(run_with_stops(matrix, settings_with_gap(0.06, 2), {40, 500, 900}), whole);
    expect_same(matrix.run(settings, &whole.saved), whole);
  }
}

/// The bound of a box may be that of a box above it.
TEST(ContinuedConditionSearch, KnowsTheBoundsOfBoxesAbove) {
  const TestMatrix matrix(kSheared);
  ConditionSettings settings = settings_with_gap(0);
  settings.max_boxes = 1200;
  expect_same(run_with_stops(matrix, settings, {300, 700}), matrix.run(settings));
}

TEST(ContinuedConditionSearch, DoesNotSplitWhatCannotBeSplit) {
  const TestMatrix matrix(kTurned);
  ConditionSettings settings = settings_with_gap(0.01);
  settings.min_relative_width = 0.2;
  const Ended whole = matrix.run(settings);
  EXPECT_EQ(whole.result.reason, Reason::kWidth);
  expect_same(run_with_stops(matrix, settings, {60, 200}), whole);
  expect_same(matrix.run(settings, &whole.saved), whole);
}

TEST(ContinuedConditionSearch, GoesOnWithAnotherGapOrLimit) {
  const TestMatrix matrix(kTurned);
  const Ended wide = matrix.run(settings_with_gap(0.2));
  const Ended narrow = matrix.run(settings_with_gap(0.05), &wide.saved);
  EXPECT_TRUE(narrow.result.is_closed);
  EXPECT_GE(narrow.result.proved, kTurnedCondition);
  EXPECT_LE(narrow.result.proved, kTurnedCondition / 0.95);
  EXPECT_GT(narrow.result.boxes, wide.result.boxes);
  ConditionSettings compared = settings_with_gap(0.01);
  compared.limit = Interval(5.6);
  const Ended within = matrix.run(compared, &wide.saved);
  EXPECT_TRUE(within.result.is_closed);
  EXPECT_LE(within.result.proved, 5.6);
}

TEST(ContinuedConditionSearch, ClaimsNothingIfItStopsTooEarly) {
  const TestMatrix matrix(kTurned);
  const Ended whole = matrix.run(settings_with_gap(0.1));
  ConditionSettings settings = settings_with_gap(0.1);
  settings.time_limit = 0;
  std::atomic<bool> interrupt = true;
  for (const bool is_interrupted : {false, true}) {
    if (is_interrupted) settings.interrupt = &interrupt;
    const Ended stopped = matrix.run(settings, &whole.saved);
    EXPECT_FALSE(stopped.result.is_continued || stopped.result.is_closed);
    EXPECT_FALSE(stopped.result.attained);
    EXPECT_EQ(stopped.result.proved, kInfinity);
    EXPECT_EQ(stopped.result.reason, is_interrupted ? Reason::kInterrupted : Reason::kTimeBudget);
    EXPECT_EQ(stopped.saves, 0);  // the file keeps what it has
  }
}

TEST(ContinuedConditionSearch, AsksAgainWhatItWasTold) {
  const TestMatrix matrix(undefined_at_an_end());
  int asked = 0;
  ConditionSettings settings = settings_with_gap(0.01);
  settings.max_boxes = 2500;
  settings.ask = [&](double) { return ++asked, ConditionHint{false, 8}; };
  const Ended whole = matrix.run(settings);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(whole.result.proved, 8);
  EXPECT_EQ(whole.saved.own, (std::vector<std::uint64_t>{1}));
  expect_same(run_with_stops(matrix, settings, {500, 1100, 1800}), whole);
  asked = 0;
  expect_same(matrix.run(settings, &whole.saved), whole);
  EXPECT_EQ(asked, 1);
  // The answer counts even if the boxes have bounds by now.
  settings.ask = [](double) { return ConditionHint{false, 5.3}; };
  const TestMatrix defined(kTurned);
  SavedTree told = defined.run(settings_with_gap(0.2)).saved;
  told.own = {1};
  EXPECT_EQ(defined.run(settings, &told).result.proved, 5.3);
  // Without the answer, the bound is not known.
  settings.ask = [](double) { return ConditionHint{}; };
  EXPECT_EQ(matrix.run(settings, &whole.saved).result.proved, kInfinity);
  settings.ask = [](double) { return ConditionHint{true, kInfinity}; };
  const Ended singular = matrix.run(settings);
  EXPECT_TRUE(singular.result.is_singular);
  expect_same(matrix.run(settings, &singular.saved), singular);
}

/// The lower end of the bracket is below κ₂, its upper end above.
void expect_no_claim_beyond(const ConditionResult& result, const std::string& text) {
  EXPECT_GE(result.proved, kTurnedCondition) << text;
  if (!result.attained) return;
  EXPECT_LE(result.attained->shown.condition, kTurnedCondition) << text;
}

TEST(ContinuedConditionSearch, DoesNotBelieveNumbers) {
  const TestMatrix matrix(kTurned);
  const ConditionSettings settings = settings_with_gap(0.1);
  const Ended whole = matrix.run(settings);
  const auto lie = [&](const char* pattern, const char* by) {
    SavedTree state = whole.saved;
    for (std::string* text : {&state.steps, &state.open})
      *text = std::regex_replace(*text, std::regex(pattern), by);
    const Ended ended = matrix.run(settings, &state);
    expect_no_claim_beyond(ended.result, by);
    EXPECT_TRUE(ended.result.is_closed) << by;
    EXPECT_EQ(ended.result.boxes, whole.result.boxes) << by;
  };
  lie("=\\S+", "=0x0p+0");
  lie("=\\S+", "-");
  lie("(\\d+)-", "$1=0x0p+0");
  SavedTree state = whole.saved;
  state.steps = std::regex_replace(state.steps, std::regex("=\\S+"), "-");
  for (const BoxId box : {BoxId{0}, whole.result.boxes - 1}) {
    state.shown = {box};
    expect_no_claim_beyond(matrix.run(settings, &state).result, std::to_string(box));
  }
}

TEST(ContinuedConditionSearch, TakesAnyTreeOfTheVariety) {
  const TestMatrix matrix(kTurned);
  ConditionSettings settings = settings_with_gap(0.1);
  settings.max_boxes = 300;
  const SavedTree saved = matrix.run(settings).saved;
  settings.max_boxes = 20000;
  std::mt19937 random(7);
  for (int i = 0; i < 100; ++i) {
    SavedTree state = saved;
    for (std::size_t at = 0; (at = state.steps.find(':', at + 1)) != std::string::npos;)
      if (random() % 10 == 0) state.steps[at + 1] = char('0' + random() % 3);
    const ConditionResult result = matrix.run(settings, &state).result;
    expect_no_claim_beyond(result, state.steps);
    EXPECT_TRUE(result.is_closed);
  }
}

TEST(ContinuedConditionSearch, OfADamagedStateIsRefusedOrRight) {
  const TestMatrix matrix(kTurned);
  ConditionSettings settings = settings_with_gap(0.1);
  settings.max_boxes = 300;
  const SavedTree saved = matrix.run(settings).saved;
  settings.max_boxes = 400;
  const std::vector<std::string> splices{
      " ",         "=", "-", "0:1 ", ":2", "7", "inf", "0x1p+0 ", "0xnan", "99999999999999999999",
      "63=0x1p+2 "};
  int refused = 0, right = 0;
  for (unsigned seed = 0; seed < 800; ++seed) {
    SavedTree state = saved;
    std::string& text = seed % 3 == 0 ? state.open : state.steps;
    text = Damage(seed, splices).done_to(text);
    try {
      expect_no_claim_beyond(matrix.run(settings, &state).result, text);
      ++right;
    } catch (const SavedTreeError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 200);
  EXPECT_GT(right, 10);
}

}  // namespace
}  // namespace regulus::detail::test
