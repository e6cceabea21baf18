// SPDX-License-Identifier: GPL-3.0-or-later
// Searches by simulated workers, and what they must agree with.
#pragma once

#include <gtest/gtest.h>

#include "tests/support/search_events.hpp"
#include "tests/support/simulated_workers.hpp"
#include "tests/support/unit_searches.hpp"

namespace regulus::detail::test {

/// Runs each case with so many seeds. Every search must tell its observer the same as the search
/// by one thread.
inline void expect_simulations_change_nothing(unsigned seeds) {
  std::size_t deaths = 0, losses = 0, repetitions = 0;
  for (const UnitCase& c : unit_cases()) {
    const Problem problem = problem_over(*c.kernel, c.ranges);
    SearchEvents expected;
    ASSERT_EQ(solve(problem, c.settings, &expected).verdict, c.verdict) << c.name;
    KnownOutcomes known;
    for (unsigned seed = 0; seed < seeds; ++seed) {
      std::mt19937 random(seed);
      const auto some = [&random](double most) {
        return random() % 3 == 0 ? 0.0 : most * static_cast<double>(random() % 100) / 100;
      };
      const Troubles troubles{some(0.3), some(0.3), some(0.1), 0.001 + some(40)};
      SimulatedWorkers workers(1 + random() % 40, troubles, seed, known);
      Settings settings = c.settings;
      settings.workers = &workers;
      SearchEvents events;
      static_cast<void>(solve(problem, settings, &events));
      ASSERT_TRUE(events.text == expected.text) << c.name << ", seed " << seed;
      deaths += workers.deaths, losses += workers.losses, repetitions += workers.repetitions;
    }
  }
  EXPECT_GT(deaths, seeds);
  EXPECT_GT(losses, seeds);
  EXPECT_GT(repetitions, seeds);
}

}  // namespace regulus::detail::test
