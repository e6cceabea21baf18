// SPDX-License-Identifier: GPL-3.0-or-later
// A search that stops and continues, however often, gives the same answer as one without a stop.
#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "tests/support/function_kernel.hpp"
#include "tests/support/simulated_workers.hpp"

namespace regulus::detail {
namespace {

using test::FunctionKernel;
using test::problem_over;
using test::Values;

/// Keeps the state that it receives at a pause, and then interrupts the search.
class Pausing : public Observer {
 public:
  Pausing(std::string& log, std::uint64_t every) : log_(log), every_(every) {}

  void on_split(const OpenBox& box, const Split& split) noexcept override {
    log_ += std::to_string(box.id) + " split " + std::to_string(split.variable) + ' ' +
            std::to_string(split.lower) + '\n';
  }
  void on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept override {
    log_ += std::to_string(box.id) + ' ' + name(rule) + '\n';
  }
  bool wants_pause() noexcept override { return every_ != 0 && ++rounds_ % every_ == 0; }
  void on_pause(const SearchState& seen, const OpenBoxes& boxes) noexcept override {
    state = seen;
    kept.clear();
    open.clear();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const OpenBox box = boxes.at(i);
      kept.emplace_back(box.box.begin(), box.box.end());
      open.push_back({box.id, box.depth, {}});
    }
    for (std::size_t i = 0; i < kept.size(); ++i) open[i].box = kept[i];
    interrupt = true;
  }

  SearchState state;
  std::vector<std::vector<Interval>> kept;
  std::vector<OpenBox> open;
  std::atomic<bool> interrupt{false};

 private:
  std::string& log_;
  std::uint64_t every_, rounds_ = 0;
};

struct Told {
  Result result;
  std::string log;
  int stops = 0;
};

/// Stops after every so many rounds. The next search starts from the last state received.
Told search(const Problem& problem, Settings settings, std::uint64_t every) {
  Told told;
  SearchState state;
  std::vector<std::vector<Interval>> kept = {problem.outer};
  std::vector<OpenBox> open = {{0, 0, kept[0]}};
  for (;; ++told.stops) {
    Pausing observer(told.log, every);
    settings.interrupt = &observer.interrupt;
    told.result = resume(problem, settings, open, state, &observer);
    if (told.result.stopped_by != Reason::kInterrupted) return told;
    state = observer.state;
    kept = observer.kept;
    open = observer.open;
    for (std::size_t i = 0; i < kept.size(); ++i) open[i].box = kept[i];
  }
}

void expect_the_same(const Problem& problem, const Settings& settings, Verdict verdict,
                     int least_stops) {
  const Told whole = search(problem, settings, 1U << 30);
  EXPECT_EQ(whole.result.verdict, verdict) << describe(whole.result.reason);
  EXPECT_EQ(whole.stops, 0);
  for (const std::uint64_t every : {1U, 2U, 7U}) {
    const Told pieces = search(problem, settings, every);
    EXPECT_GE(pieces.stops, least_stops / static_cast<int>(every));
    EXPECT_TRUE(pieces.log == whole.log) << every;
    EXPECT_EQ(pieces.result.verdict, verdict);
    EXPECT_EQ(pieces.result.reason, whole.result.reason);
    EXPECT_EQ(pieces.result.blocking_box, whole.result.blocking_box);
    EXPECT_EQ(pieces.result.statistics.boxes, whole.result.statistics.boxes);
    EXPECT_EQ(pieces.result.statistics.leaves, whole.result.statistics.leaves);
  }
}

TEST(Pause, AProofIsTheSameInPieces) {
  FunctionKernel kernel = test::singular_circle();
  kernel.with_constraints(1, [](const Values& x) { return Values{sqr(x[0]) + sqr(x[1]) - 0.9}; });
  expect_the_same(problem_over(kernel, {{-2, 2}, {-2, 2}}), {}, Verdict::kNoSingularity, 8);
}

/// A box that was undecided before a stop is not forgotten: without it the rest would be free.
TEST(Pause, ABlockedBoxStaysBlocked) {
  const FunctionKernel kernel(2, 2, 2, [](const Values& x) {
    return Values{x[0] - Interval(0.3), x[1], -x[1], x[0] - Interval(0.3)};
  });
  Settings settings;
  settings.ingredients.descents = settings.ingredients.corners = false;
  expect_the_same(problem_over(kernel, {{-1, 1}, {-1, 1}}), settings, Verdict::kPossibleProblem, 8);
}

TEST(Pause, APavingIsTheSameInPieces) {
  const FunctionKernel kernel = test::singular_circle();
  Settings settings;
  settings.exhaustive = true;
  settings.min_relative_width = 0x1p-5;
  expect_the_same(problem_over(kernel, {{-2, 2}, {-2, 2}}), settings, Verdict::kSingularity, 8);
}

/// Cuts a search into units early.
Settings in_units() {
  Settings settings;
  settings.boxes_before_units = 64;
  settings.boxes_of_unit = 16;
  return settings;
}

TEST(Pause, UnitsOfAProofAreTheSameInPieces) {
  FunctionKernel kernel = test::singular_circle();
  kernel.with_constraints(1, [](const Values& x) { return Values{sqr(x[0]) + sqr(x[1]) - 0.9}; });
  expect_the_same(problem_over(kernel, {{-2, 2}, {-2, 2}}), in_units(), Verdict::kNoSingularity, 8);
}

TEST(Pause, UnitsWithABlockedBoxAreTheSameInPieces) {
  const FunctionKernel kernel(2, 2, 2, [](const Values& x) {
    return Values{x[0] - Interval(0.3), x[1], -x[1], x[0] - Interval(0.3)};
  });
  Settings settings = in_units();
  settings.ingredients.descents = settings.ingredients.corners = false;
  expect_the_same(problem_over(kernel, {{-1, 1}, {-1, 1}}), settings, Verdict::kPossibleProblem, 8);
}

TEST(Pause, UnitsOfAPavingAreTheSameInPieces) {
  const FunctionKernel kernel = test::singular_circle();
  Settings settings = in_units();
  settings.exhaustive = true;
  settings.min_relative_width = 0x1p-5;
  expect_the_same(problem_over(kernel, {{-2, 2}, {-2, 2}}), settings, Verdict::kSingularity, 8);
}

/// Stops again and again, by many workers, whose outcomes come in any order. Those that are not in order
/// at a stop are lost.
TEST(Pause, UnitsByManyWorkersAreTheSameInPieces) {
  const FunctionKernel kernel = test::singular_circle();
  Settings settings = in_units();
  settings.exhaustive = true;
  settings.min_relative_width = 0x1p-6;
  const Problem problem = problem_over(kernel, {{-2, 2}, {-2, 2}});
  constexpr std::uint64_t kNever = 1U << 30;
  const std::string expected = search(problem, settings, kNever).log;
  std::string log;
  SearchState state;
  std::vector<std::vector<Interval>> kept = {problem.outer};
  std::vector<OpenBox> open = {{0, 0, kept[0]}};
  unsigned stops = 0;
  for (bool is_stopped = true; is_stopped; ++stops) {
    Pausing observer(log, 4);
    test::KnownOutcomes decided;
    test::SimulatedWorkers workers(12, {.longest_delay = 2}, stops, decided);
    settings.workers = &workers;
    settings.interrupt = &observer.interrupt;
    const Result result = resume(problem, settings, open, state, &observer);
    is_stopped = result.stopped_by == Reason::kInterrupted;
    state = observer.state;
    kept = observer.kept;
    open = observer.open;
    for (std::size_t i = 0; i < kept.size(); ++i) open[i].box = kept[i];
  }
  EXPECT_GT(stops, 2U);
  EXPECT_TRUE(log == expected);
}

/// Stops at each of these budgets, and continues to the end.
Told search_with_budgets(const Problem& problem, Settings settings,
                         const std::vector<std::uint64_t>& budgets) {
  Told told;
  SearchState state;
  std::vector<std::vector<Interval>> kept = {problem.outer};
  std::vector<OpenBox> open = {{0, 0, kept[0]}};
  for (const std::uint64_t budget : budgets) {
    Pausing observer(told.log, 0);
    settings.max_boxes = budget;
    told.result = resume(problem, settings, open, state, &observer);
    if (told.result.stopped_by != Reason::kBoxBudget) return told;
    EXPECT_LE(told.result.statistics.boxes, budget);
    ++told.stops;
    state = observer.state;
    kept = observer.kept;
    open = observer.open;
    for (std::size_t i = 0; i < kept.size(); ++i) open[i].box = kept[i];
  }
  return told;
}

void expect_the_same_with_budgets(const Problem& problem, const Settings& settings,
                                  Verdict verdict) {
  constexpr std::uint64_t kAll = 1U << 30;
  const Told whole = search(problem, settings, kAll);
  EXPECT_EQ(whole.result.verdict, verdict) << describe(whole.result.reason);
  const std::uint64_t boxes = whole.result.statistics.boxes;
  ASSERT_GE(boxes, 64U);
  std::vector<std::vector<std::uint64_t>> lists = {
      {1, 2, 3, 5, 8, 13, 21, 34, 55, kAll}, {boxes / 2, boxes / 2, kAll}, {boxes - 1, kAll}};
  for (std::uint64_t budget = 2; budget < boxes; budget += 1 + boxes / 13)
    lists.push_back({budget, kAll});
  for (const std::vector<std::uint64_t>& budgets : lists) {
    const Told pieces = search_with_budgets(problem, settings, budgets);
    EXPECT_GE(pieces.stops, 1);
    EXPECT_TRUE(pieces.log == whole.log) << budgets[0];
    EXPECT_EQ(pieces.result.verdict, verdict);
    EXPECT_EQ(pieces.result.statistics.boxes, boxes);
    EXPECT_EQ(pieces.result.statistics.leaves, whole.result.statistics.leaves);
    EXPECT_EQ(pieces.result.statistics.max_frontier, whole.result.statistics.max_frontier);
    EXPECT_EQ(pieces.result.witness.has_value(), whole.result.witness.has_value());
    if (!pieces.result.witness || !whole.result.witness) continue;
    for (std::size_t i = 0; i < whole.result.witness->points.size(); ++i)
      EXPECT_EQ(pieces.result.witness->points.at(i).variables,
                whole.result.witness->points[i].variables);
  }
}

TEST(ABudget, LeavesAProofAsItIs) {
  FunctionKernel kernel = test::singular_circle();
  kernel.with_constraints(1, [](const Values& x) { return Values{sqr(x[0]) + sqr(x[1]) - 0.9}; });
  expect_the_same_with_budgets(problem_over(kernel, {{-2, 2}, {-2, 2}}), {},
                               Verdict::kNoSingularity);
}

TEST(ABudget, LeavesABlockedSearchAsItIs) {
  const FunctionKernel kernel(2, 2, 2, [](const Values& x) {
    return Values{x[0] - Interval(0.3), x[1], -x[1], x[0] - Interval(0.3)};
  });
  expect_the_same_with_budgets(problem_over(kernel, {{-1, 1}, {-1, 1}}), {},
                               Verdict::kPossibleProblem);
}

TEST(ABudget, LeavesUnitsAsTheyAre) {
  FunctionKernel kernel = test::singular_circle();
  kernel.with_constraints(1, [](const Values& x) { return Values{sqr(x[0]) + sqr(x[1]) - 0.9}; });
  expect_the_same_with_budgets(problem_over(kernel, {{-2, 2}, {-2, 2}}), in_units(),
                               Verdict::kNoSingularity);
}

/// The sign of 2·x·y − 1.9999 changes near two corners only. The search remembers a sign that it
/// saw before a stop.
TEST(ABudget, LeavesTheWitnessAsItIs) {
  const FunctionKernel kernel(2, 2, 2, [](const Values& x) {
    return Values{x[0] * x[0] + x[1] * x[1] - Interval(1.9999), x[0] - x[1], x[0] - x[1],
                  Interval(1.0)};
  });
  Settings settings;
  settings.ingredients.descents = settings.ingredients.corners = false;
  expect_the_same_with_budgets(problem_over(kernel, {{-1, 1}, {-1, 1}}), settings,
                               Verdict::kSingularity);
}

}  // namespace
}  // namespace regulus::detail
