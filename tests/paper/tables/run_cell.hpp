// SPDX-License-Identifier: GPL-3.0-or-later
// Runs one cell of a table, from the model file to the verdict.
#pragma once

#include <ctime>
#include <string>

#include "codegen/question/engine/choices.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/engine/settings.hpp"
#include "runtime/search/solver.hpp"
#include "tests/paper/tables/paper_tables.hpp"

namespace regulus::detail::test {

/// The question of a table's cell, in words of the command line.
struct Question {
  std::string model;  ///< below the source tree
  std::string motion;
  std::vector<std::string> ranges = {};
  std::vector<std::string> tolerances = {};
  std::string alpha = {};

  [[nodiscard]] ModelOptions options() const {
    return {REGULUS_SOURCE_DIR "/" + model, motion, ranges, tolerances, alpha};
  }
};

/// Runs a search and measures processor time, which depends less on other load of the machine.
inline Result timed(const PreparedSearch& preparation, const Settings& settings) {
  const std::clock_t start = std::clock();
  Result result = solve(preparation.problem(), settings);
  result.statistics.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return result;
}

/// Returns the quickest of three runs, or of more while they take little time together.
inline Result quickest(const PreparedSearch& preparation, const Settings& settings) {
  constexpr double kLittle = 0.05, kMuch = 0.2;
  Result best = timed(preparation, settings);
  if (best.stopped_by) return best;
  double spent = best.statistics.seconds;
  for (int runs = 1; spent < kMuch && (runs < 3 || spent < kLittle); ++runs) {
    Result next = timed(preparation, settings);
    spent += next.statistics.seconds;
    if (next.statistics.seconds < best.statistics.seconds) best = std::move(next);
  }
  return best;
}

/// Each search has the time limit search.time_limit.
inline Result run(const Question& question, const SearchOptions& search) {
  return quickest(prepare(question.options(), search), settings_from(search));
}

/// How a cell is run: with the defaults of the command, or as the paper describes its search:
/// entries by natural evaluation, without derivatives; determinants by expansion; one thread.
enum class Manner { kDefaults, kAsInThePaper };

/// Searches for at most `seconds`; 0: no limit.
inline Result run(const PaperTable& table, const PaperCell& cell, double seconds,
                  Manner manner = Manner::kDefaults, Bisection bisection = Bisection::kImpact) {
  Question question{std::string("models/") + table.model + ".toml", cell.motion};
  if (*cell.tolerance != '\0')
    question.tolerances.push_back(std::string("base,platform=") + cell.tolerance);
  SearchOptions search;
  search.method = choice_of<Method>("--method", cell.method);
  search.uncertainty = choice_of<Uncertainty>("--uncertainty", cell.uncertainty);
  search.time_limit = seconds;
  search.bisection = bisection;
  if (manner == Manner::kAsInThePaper) {
    search.entries = Entries::kNatural;
    search.determinant = Determinant::kExpansion;
    search.threads = 1;
  }
  const PreparedSearch preparation = prepare(question.options(), search);
  return solve(preparation.problem(), settings_from(search));
}

}  // namespace regulus::detail::test
