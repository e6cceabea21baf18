// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/cluster/supervisor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/cluster/worker.hpp"

namespace regulus::detail::cluster {
namespace {

/// A box is a number here. A unit of one box with number n > 0 leaves n − 1 twice.
Unit unit_of(double number) { return {{1}, {Interval(number)}}; }

std::string outcome_of(const Unit& unit) {
  Outcome outcome;
  outcome.boxes = 10;
  const double number = unit.ranges[0].lo;
  if (number > 0) outcome.groups = {unit_of(number - 1), unit_of(number - 1)};
  outcome.events = std::to_string(number);
  return write_outcome(outcome);
}

class Deciding : public UnitDecider {
 public:
  std::optional<std::string> decide(const Unit& unit) override {
    ++units;
    return outcome_of(unit);
  }
  int units = 0;
};

double no_time() { return 0; }

/// Lets a worker decide a grant to the end.
std::string answer_to(const std::string& grant) {
  Deciding decider;
  Worker worker;
  worker.receive(grant);
  for (;;)
    if (const auto answer = worker.step(decider, no_time)) return *answer;
}

/// Takes what is in order; returns the numbers of its boxes.
std::vector<double> taken(Supervisor& supervisor) {
  std::vector<double> numbers;
  while (const auto decided = supervisor.first()) {
    EXPECT_EQ(*decided->outcome, outcome_of(*decided->unit));
    numbers.push_back(decided->unit->ranges[0].lo);
    supervisor.remove_first();
  }
  return numbers;
}

using testing::ElementsAre;

TEST(Supervisor, GivesTwoGrantsToEachWorkerTheFirstUnitsFirst) {
  Supervisor supervisor({unit_of(5), unit_of(6), unit_of(7), unit_of(8), unit_of(9)}, 2, {});
  const auto grants = supervisor.grant_work(0);
  ASSERT_EQ(grants.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(read_grant(grants[i].grant).units.at(0), unit_of(5 + static_cast<double>(i)));
  EXPECT_EQ(supervisor.waiting(), 1U);
  EXPECT_TRUE(supervisor.grant_work(0).empty());
}

TEST(Supervisor, PutsOutcomesInTheOrderOfTheTree) {
  Supervisor supervisor({unit_of(1), unit_of(4)}, 2, {});
  const auto grants = supervisor.grant_work(0);
  supervisor.receive(1, answer_to(grants[1].grant), 0);
  EXPECT_FALSE(supervisor.first());
  supervisor.receive(0, answer_to(grants[0].grant), 0);
  EXPECT_THAT(taken(supervisor), ElementsAre(1));
  // The groups of the first unit come before the second one.
  const auto more = supervisor.grant_work(0);
  EXPECT_EQ(read_grant(more.at(0).grant).units.at(0), unit_of(0));
  EXPECT_EQ(read_grant(more.at(1).grant).units.at(0), unit_of(0));
  EXPECT_EQ(read_grant(more.at(2).grant).units.at(0), unit_of(3));
}

TEST(Supervisor, GivesWorkAgainThatIsNotAnsweredInTime) {
  Supervisor supervisor({unit_of(0)}, 2, {.seconds = 1, .patience = 10});
  const auto first = supervisor.grant_work(0);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_TRUE(supervisor.grant_work(9).empty());
  EXPECT_TRUE(supervisor.standing_still().empty());
  const auto second = supervisor.grant_work(11);
  ASSERT_EQ(second.size(), 1U);
  EXPECT_NE(second[0].worker, first[0].worker);
  EXPECT_THAT(supervisor.standing_still(), ElementsAre(first[0].worker));
  // The late answer counts, and so does the other one, which is the same.
  supervisor.receive(first[0].worker, answer_to(first[0].grant), 12);
  EXPECT_TRUE(supervisor.standing_still().empty());
  supervisor.receive(second[0].worker, answer_to(second[0].grant), 13);
  EXPECT_THAT(taken(supervisor), ElementsAre(0));
  EXPECT_TRUE(supervisor.empty());
}

TEST(Supervisor, RefusesTwoOutcomesOfOneUnit) {
  Supervisor supervisor({unit_of(5), unit_of(0)}, 2, {.seconds = 1, .patience = 10});
  const auto first = supervisor.grant_work(0);
  const auto second = supervisor.grant_work(11);
  EXPECT_TRUE(second.empty()) << "both stand still";
  supervisor.receive(0, write_answer({}), 12);
  const auto third = supervisor.grant_work(12);
  ASSERT_EQ(third.size(), 2U);
  supervisor.receive(0, answer_to(third[1].grant), 13);
  Answer other = read_answer(answer_to(first[1].grant));
  other.results[0].outcome.back() ^= 1;
  EXPECT_THROW(supervisor.receive(first[1].worker, write_answer(other), 14), Disagreement);
}

TEST(Supervisor, TakesMoreUnitsWhileAnswersAreLate) {
  Supervisor supervisor({unit_of(0)}, 2, {.seconds = 1, .patience = 10});
  const auto first = supervisor.grant_work(0);
  const auto second = supervisor.grant_work(11);
  supervisor.receive(second.at(0).worker, answer_to(second[0].grant), 12);
  EXPECT_THAT(taken(supervisor), ElementsAre(0));
  supervisor.add({unit_of(0.5), unit_of(-1)});
  const auto third = supervisor.grant_work(12);
  ASSERT_EQ(third.size(), 2U);
  for (const auto& grant : third) EXPECT_NE(grant.worker, first[0].worker) << "it stands still";
  // The answer to the first grant says nothing about the new units.
  supervisor.receive(first[0].worker, answer_to(first[0].grant), 13);
  EXPECT_FALSE(supervisor.first());
  supervisor.receive(third[1].worker, answer_to(third[1].grant), 14);
  EXPECT_FALSE(supervisor.first());
  supervisor.receive(third[0].worker, answer_to(third[0].grant), 14);
  EXPECT_THAT(taken(supervisor), ElementsAre(0.5));
}

TEST(Supervisor, AnswersThatItDoesNotExpectChangeNothing) {
  Supervisor supervisor({unit_of(0), unit_of(0)}, 1, {});
  const auto grants = supervisor.grant_work(0);
  const std::string answer = answer_to(grants[0].grant);
  supervisor.receive(0, answer, 0);
  supervisor.receive(0, answer, 0);
  Answer strange = read_answer(answer);
  strange.grant = 77;
  supervisor.receive(0, write_answer(strange), 0);
  EXPECT_EQ(taken(supervisor).size(), 1U);
  EXPECT_FALSE(supervisor.empty());
}

/// A box of number n, at this depth.
Unit deep_unit_of(double number, std::uint32_t depth) { return {{depth}, {Interval(number)}}; }

TEST(Supervisor, GrantsTheWidestFirstIfFewUnitsWait) {
  Supervisor supervisor({deep_unit_of(5, 9), deep_unit_of(6, 3), deep_unit_of(7, 6)}, 3, {});
  const auto grants = supervisor.grant_work(0);
  ASSERT_EQ(grants.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(read_grant(grants[i].grant).units.at(0).depths.at(0), 3 * (i + 1));
}

TEST(Supervisor, GrantsTheFirstInOrderIfManyWait) {
  std::vector<Unit> units;
  for (std::uint32_t i = 0; i < 12; ++i) units.push_back(deep_unit_of(1, 20 - i));
  Supervisor supervisor(units, 2, {});
  EXPECT_EQ(read_grant(supervisor.grant_work(0).at(0).grant).units.at(0).depths.at(0), 20U);
}

TEST(Worker, DecidesGroupsUntilTheBudgetIsUsed) {
  for (const auto& [budget, units] : {std::pair{1U, 1}, {25U, 3}, {1000U, 15}}) {
    Deciding decider;
    Worker worker;
    worker.receive(write_grant({1, budget, {unit_of(3)}}));
    std::optional<std::string> answer;
    while (!answer) answer = worker.step(decider, no_time);
    EXPECT_EQ(decider.units, units) << budget;
    EXPECT_EQ(read_answer(*answer).results.size(), static_cast<std::size_t>(units));
    EXPECT_FALSE(worker.has_work());
  }
}

TEST(Worker, RemindsTheSupervisorOnlyIfItHasNothingToDo) {
  Worker worker;
  EXPECT_TRUE(worker.tick(10));
  EXPECT_FALSE(worker.tick(10.5));
  EXPECT_TRUE(worker.tick(11));
  worker.receive(write_grant({1, 1, {unit_of(3)}}));
  EXPECT_FALSE(worker.tick(20));
}

TEST(Messages, DamagedOnesAreRefused) {
  const std::string grant = write_grant({300, 7, {unit_of(3), unit_of(4)}});
  const std::string answer = write_answer({300, 0.5, {{2, outcome_of(unit_of(3))}}});
  const std::string outcome = outcome_of(unit_of(2));
  for (std::size_t size = 0; size < grant.size(); ++size)
    EXPECT_THROW(static_cast<void>(read_grant(grant.substr(0, size))), MalformedMessage) << size;
  for (std::size_t size = 0; size < answer.size(); ++size)
    EXPECT_THROW(static_cast<void>(read_answer(answer.substr(0, size))), MalformedMessage) << size;
  EXPECT_THROW(static_cast<void>(read_outcome(std::string(20, '\xff'))), MalformedMessage);
  EXPECT_EQ(read_outcome(outcome).groups.size(), 2U);
  EXPECT_EQ(write_outcome(read_outcome(outcome)), outcome);
}

}  // namespace
}  // namespace regulus::detail::cluster
