// SPDX-License-Identifier: GPL-3.0-or-later
// A prepared search can be run again, with the same events to the last bit; a solver that is kept
// while all ranges move does what a new one does.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "runtime/search/solver.hpp"
#include "tests/support/search_events.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::kept_search {
namespace {

struct Question {
  const char* model;
  const char* motion;
  const char* tolerance;
};

PreparedSearch prepared(const Question& question, const SearchOptions& search,
                        const char* alpha = "") {
  ModelOptions model;
  model.path = std::string(REGULUS_SOURCE_DIR "/models/") + question.model;
  model.motion = question.motion;
  if (*question.tolerance != '\0') model.tolerances = {question.tolerance};
  model.alpha = alpha;
  return prepare(model, search);
}

std::string events_of(PreparedSearch& preparation, const SearchOptions& search) {
  test::SearchEvents events;
  static_cast<void>(run_search(preparation, search, settings_from(search), &events));
  return events.text;
}

TEST(KeptSearch, RepeatsItselfToTheBit) {
  for (const Question& question : {Question{"robot_1.toml", "wide_15", "base,platform=0.1"},
                                   {"robot_1.toml", "T2_errors", "base,platform=0.05"},
                                   {"robot_1.toml", "wide_40", ""},
                                   {"robot_2.toml", "table5_30", ""},
                                   {"delta.toml", "work", ""}}) {
    SearchOptions search;
    search.threads = 1;
    search.engine = Engine::kInterpreted;
    PreparedSearch preparation = prepared(question, search);
    const std::string first = events_of(preparation, search);
    EXPECT_FALSE(first.empty());
    for (int again = 0; again < 2; ++again)
      EXPECT_TRUE(events_of(preparation, search) == first) << question.motion;
    PreparedSearch moved = std::move(preparation);
    EXPECT_TRUE(events_of(moved, search) == first) << question.motion;
  }
}

/// Makes every range smaller, of uncertain quantities too.
void shrink(Problem& problem, std::mt19937& random) {
  std::uniform_real_distribution<double> part(0.05, 1.0);
  for (std::size_t k = 0; k < problem.outer.size(); ++k) {
    const double middle = mid(problem.outer[k]), factor = part(random);
    const auto shrunk = [&](Interval x) {
      return Interval(middle - factor * (middle - x.lo), middle + factor * (x.hi - middle));
    };
    problem.outer[k] = shrunk(problem.outer[k]);
    if (problem.inner[k]) problem.inner[k] = intersect(shrunk(*problem.inner[k]), problem.outer[k]);
  }
}

std::string events_of(Solver& solver, const Problem& problem, const Settings& settings) {
  test::SearchEvents events;
  static_cast<void>(solver.solve(problem, settings, &events));
  return events.text;
}

TEST(KeptSearch, FollowsAllRangesToTheBit) {
  std::mt19937 random(11);
  for (const Question& question : {Question{"robot_1.toml", "wide_15", "base,platform=0.1"},
                                   {"robot_1.toml", "T2_errors", "base,platform=0.05"},
                                   {"robot_1.toml", "wide_40", ""},
                                   {"robot_2.toml", "table5_30", "base,platform=0.02"},
                                   {"delta.toml", "work", "arms=0.001"},
                                   {"hexapod_6rus.toml", "work", ""}})
    for (const char* alpha : {"0", "1/1000"})
      for (const unsigned threads : {1U, 2U}) {
        if (threads == 1 && test::trials(0, 1) == 0 && alpha[1] == '/') continue;
        SearchOptions search;
        search.threads = threads;
        search.engine = Engine::kInterpreted;
        search.max_boxes = 70;
        const PreparedSearch preparation = prepared(question, search, alpha);
        const Settings settings = settings_from(search);
        const Problem whole = preparation.problem();
        Solver kept;
        std::set<std::string> different;
        for (int step = 0; step < test::trials(3, 6); ++step) {
          Problem problem = whole;
          if (step % 3 != 0) shrink(problem, random);
          Solver fresh;
          const std::string events = events_of(fresh, problem, settings);
          EXPECT_TRUE(events_of(kept, problem, settings) == events)
              << question.motion << ' ' << alpha << ' ' << threads << ' ' << step;
          different.insert(events);
        }
        if (std::string(alpha) == "0") {
          EXPECT_GE(different.size(), 3U) << question.motion;
        }
      }
}

}  // namespace
}  // namespace regulus::detail::kept_search
