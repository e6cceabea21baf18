// SPDX-License-Identifier: GPL-3.0-or-later
// A search of units tells its observer the same for any number of threads, to the last bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "runtime/search/unit_events.hpp"
#include "runtime/search/unit_groups.hpp"
#include "runtime/search/unit_search.hpp"
#include "tests/support/search_events.hpp"
#include "tests/support/unit_searches.hpp"

namespace regulus::detail {
namespace {

using test::problem_over;
using test::SearchEvents;
using test::UnitCase;

std::string events_of(const UnitCase& c, unsigned threads) {
  Settings settings = c.settings;
  settings.threads = threads;
  SearchEvents events;
  const Result result = solve(problem_over(*c.kernel, c.ranges), settings, &events);
  EXPECT_EQ(result.verdict, c.verdict) << c.name << ": " << describe(result.reason);
  EXPECT_GT(result.statistics.boxes, settings.boxes_before_units) << c.name;
  return events.text;
}

TEST(Units, AreTheSameForAnyNumberOfThreads) {
  for (const UnitCase& c : test::unit_cases()) {
    const std::string expected = events_of(c, 1);
    for (const unsigned threads : {2U, 3U, 8U})
      EXPECT_TRUE(events_of(c, threads) == expected) << c.name << ", " << threads << " threads";
  }
}

/// Units change which boxes are decided together, and so nothing about a box itself.
TEST(Units, LeaveTheTreeOfAPavingAsItIs) {
  for (const UnitCase& c : test::unit_cases()) {
    if (!c.settings.exhaustive) continue;
    Settings settings = c.settings;
    const Problem problem = problem_over(*c.kernel, c.ranges);
    const Result cut = solve(problem, settings);
    settings.boxes_before_units = ~std::uint64_t{0};
    const Result whole = solve(problem, settings);
    EXPECT_EQ(cut.statistics.boxes, whole.statistics.boxes);
    EXPECT_EQ(cut.statistics.leaves, whole.statistics.leaves);
  }
}

TEST(Units, KeepEveryBoxWhenTheyAreInterrupted) {
  class InterruptsAfter : public SearchEvents {
   public:
    explicit InterruptsAfter(std::uint64_t boxes) : after_(boxes) {}
    void on_leaf(const OpenBox& box, Rule, const Proof&) noexcept override { add(box); }
    void on_open(const OpenBox& box) noexcept override { add(box); }
    void on_progress(const Statistics& statistics, std::uint64_t) noexcept override {
      if (statistics.boxes >= after_) interrupt = true;
    }
    std::atomic<bool> interrupt{false};
    void on_split(const OpenBox&, const Split&) noexcept override { ++splits; }
    double part = 0;
    std::uint64_t splits = 0, ends = 0;

   private:
    void add(const OpenBox& box) noexcept {
      part += std::ldexp(1.0, -static_cast<int>(box.depth));
      ++ends;
    }
    const std::uint64_t after_;
  };
  const auto cases = test::unit_cases();
  const UnitCase& c = cases.front();
  for (const unsigned threads : {1U, 4U})
    for (std::uint64_t after = 65; after < 500; after += 23) {
      InterruptsAfter observer(after);
      Settings settings = c.settings;
      settings.threads = threads;
      settings.interrupt = &observer.interrupt;
      const Result result = solve(problem_over(*c.kernel, c.ranges), settings, &observer);
      EXPECT_NEAR(observer.part, 1.0, 1e-12) << after;
      EXPECT_EQ(observer.ends, observer.splits + 1) << after;
      const bool ended = result.verdict == Verdict::kNoSingularity;
      EXPECT_TRUE(ended || result.stopped_by == Reason::kInterrupted) << after;
    }
}

TEST(Units, WithoutBoxesAreAFault) {
  const auto cases = test::unit_cases();
  Settings settings;
  settings.boxes_of_unit = 0;
  EXPECT_EQ(solve(problem_over(*cases[0].kernel, cases[0].ranges), settings).reason,
            Reason::kBadProblem);
}

/// What a decider has done before does not matter.
TEST(AUnit, HasOneOutcome) {
  const auto cases = test::unit_cases();
  const UnitCase& c = cases.front();
  const Problem problem = problem_over(*c.kernel, c.ranges);
  const RowStructure structure = find_row_structure(problem, c.settings);
  const cluster::Learned learned;
  const std::atomic<bool> stop = false;
  WitnessSearch one(problem, c.settings, false), other(problem, c.settings, false);
  UnitSearch first(problem, c.settings, structure, learned, one, stop);
  UnitSearch second(problem, c.settings, structure, learned, other, stop);
  std::vector<cluster::Unit> units = {{{0}, c.ranges}};
  std::vector<std::string> outcomes;
  for (std::size_t i = 0; i < units.size() && i < 40; ++i) {
    outcomes.push_back(first.decide(units[i]).value());
    for (cluster::Unit& group : cluster::read_groups(outcomes.back()))
      units.push_back(std::move(group));
  }
  EXPECT_GT(outcomes.size(), 20U);
  for (std::size_t i = outcomes.size(); i-- > 0;) EXPECT_EQ(second.decide(units[i]), outcomes[i]);
  const std::atomic<bool> stopped = true;
  EXPECT_FALSE(UnitSearch(problem, c.settings, structure, learned, one, stopped).decide(units[0]));
}

TEST(Groups, AreNeighboursOfAboutTheSameVolume) {
  using Sizes = std::vector<std::size_t>;
  const auto cut = [](const std::vector<std::uint32_t>& depths, std::size_t most) {
    return cut_into_groups(depths, most);
  };
  EXPECT_EQ(cut({}, 4), Sizes());
  EXPECT_EQ(cut({7}, 4), Sizes({1}));
  EXPECT_EQ(cut({5, 5, 5, 5, 5, 5, 5, 5}, 4), Sizes({2, 2, 2, 2}));
  EXPECT_EQ(cut({9, 9, 8, 7, 6, 5}, 2), Sizes({5, 1})) << "the widest box alone";
  EXPECT_EQ(cut({900000, 900000, 3}, 2), Sizes({2, 1}));
  for (const std::size_t most : {1U, 2U, 4U, 64U}) {
    const std::vector<std::uint32_t> depths = {12, 12, 11, 9, 30, 30, 8, 8, 5, 4, 4, 2};
    const Sizes sizes = cut(depths, most);
    EXPECT_LE(sizes.size(), most);
    EXPECT_EQ(std::accumulate(sizes.begin(), sizes.end(), std::size_t{0}), depths.size());
    EXPECT_EQ(std::count(sizes.begin(), sizes.end(), 0U), 0);
  }
}

TEST(UnitEvents, AreReadAsTheyWereWritten) {
  Settings settings;
  settings.enclose_determinants = true;
  UnitTree tree(settings);
  tree.begin(2);
  const BoxId halves = tree.split(0, 200);
  Decision leaf;
  leaf.rule = Rule::kWitness;
  leaf.reason = Reason::kOppositeSigns;
  leaf.determinant = Interval(1, 2);
  WitnessPoint point;
  point.variables = {Interval(3)};
  point.places = {PlaceInRange::kLowerEnd};
  point.numbers = {{1, 2, 1}};
  leaf.witness = Witness{{point}, {}};
  tree.set_leaf(halves + 1, leaf);
  std::vector<BoxId> open;
  const std::string bytes = tree.events(2, open);
  EXPECT_EQ(open, (std::vector<BoxId>{halves, 1}));
  cluster::ByteReader reader(bytes);
  const UnitEvent split = take_event(reader, settings);
  EXPECT_EQ(split.kind, UnitEvent::Kind::kSplit);
  EXPECT_EQ(split.decision.variable, 200U);
  EXPECT_EQ(take_event(reader, settings).kind, UnitEvent::Kind::kOpen);
  const Decision read = take_event(reader, settings).decision;
  EXPECT_EQ(read.rule, Rule::kWitness);
  EXPECT_EQ(read.reason, Reason::kOppositeSigns);
  EXPECT_EQ(read.determinant, leaf.determinant);
  EXPECT_EQ(read.witness->points.at(0).places, point.places);
  EXPECT_EQ(read.witness->points.at(0).numbers, point.numbers);
  EXPECT_EQ(take_event(reader, settings).kind, UnitEvent::Kind::kOpen);
  EXPECT_TRUE(reader.at_end());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    cluster::ByteReader cut(std::string_view(bytes).substr(0, size));
    EXPECT_THROW(for (;;) static_cast<void>(take_event(cut, settings)), cluster::MalformedMessage);
  }
}

}  // namespace
}  // namespace regulus::detail
