// SPDX-License-Identifier: GPL-3.0-or-later
// Runs every cell of the paper's Tables IV–VII and prints them beside the paper's figures, as
// Markdown. Usage: paper_tables [SECONDS PER CELL].
#include <fmt/format.h>

#include <cstdlib>
#include <iostream>

#include "paper/tables/paper_times.hpp"
#include "regulus/codegen/driver/pipeline.hpp"
#include "regulus/codegen/driver/settings.hpp"
#include "regulus/search/solver.hpp"

namespace regulus::test {
namespace {

using namespace regulus::codegen;

struct Outcome {
  Result result;
  double limit;
};

Outcome run(const PaperCell& cell, double limit) {
  ModelOptions model;
  model.path = fmt::format("{}/models/{}.toml", REGULUS_SOURCE_DIR, cell.model);
  model.motion = cell.motion;
  if (*cell.tolerance != '\0')
    model.tolerances.push_back(fmt::format("base,platform={}", cell.tolerance));
  SearchOptions search;
  search.method = cell.method;
  search.uncertainty = cell.uncertainty;
  search.time_limit = limit;
  const Preparation preparation = prepare(model, search);
  return {solve(preparation.problem(), settings_from(search)), limit};
}

std::string verdict_words(const PaperCell& cell, const Outcome& outcome) {
  const Result& result = outcome.result;
  if (result.reason == Reason::kTimeBudget) return "–";
  const Verdict expected = cell.verdict == kNone ? Verdict::kNoSingularity : Verdict::kSingularity;
  if (result.verdict == expected) return name(result.verdict);
  return fmt::format("{} ({}); the paper: {}", name(result.verdict), describe(result.reason),
                     name(expected));
}

std::string seconds_words(const Outcome& outcome) {
  if (outcome.result.reason == Reason::kTimeBudget) return fmt::format("> {:g}", outcome.limit);
  return fmt::format("{:.2g}", outcome.result.statistics.seconds);
}

std::string line(const PaperCell& cell, double limit) {
  const Outcome outcome = run(cell, limit);
  return fmt::format(
      "| {} | {} {} | {} | {} | {} | {} | {} | {} |\n", cell.table, cell.model, cell.motion,
      *cell.tolerance == '\0' ? "" : fmt::format("±{}", cell.tolerance),
      *cell.tolerance == '\0' ? cell.method : fmt::format("{}, {}", cell.method, cell.uncertainty),
      *cell.seconds == '\0' ? "–" : cell.seconds, seconds_words(outcome),
      outcome.result.statistics.boxes, verdict_words(cell, outcome));
}

std::string head(double limit) {
  return fmt::format(
      "# Tables IV–VII of the paper\n\n"
      "Written by `make paper LIMIT={:g}`. Seconds are those of the search alone, as in the paper\n"
      "(a 1.7 GHz laptop); a cell that took longer than {:g} s is shown as `> {:g}`, with the "
      "boxes\n"
      "evaluated until then. `auto` is not one of the paper's methods. `elements` is the paper's "
      "D,\n"
      "`variables` its V.\n\n"
      "| table | motion | tolerance | method | paper, s | s | boxes | verdict |\n"
      "|---|---|---|---|---|---|---|---|\n",
      limit, limit, limit);
}

}  // namespace
}  // namespace regulus::test

int main(int argc, char** argv) {
  const double limit = argc > 1 ? std::atof(argv[1]) : 10;
  if (!(limit > 0)) {
    std::cerr << "usage: paper_tables [SECONDS PER CELL]\n";
    return 64;
  }
  std::cout << regulus::test::head(limit);
  for (const regulus::test::PaperCell& cell : regulus::test::kPaperCells)
    std::cout << regulus::test::line(cell, limit) << std::flush;
}
