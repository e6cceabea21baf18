// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/search_run.hpp"

#include <unistd.h>

#include <cstdio>
#include <optional>

#include "regulus/codegen/driver/arb_oracle.hpp"
#include "regulus/codegen/driver/progress.hpp"
#include "regulus/search/observers.hpp"
#include "regulus/search/solver.hpp"

namespace regulus::codegen {

Result run_search(Preparation& preparation, const SearchOptions& search,
                  const OutputOptions& output, Settings settings, Observer* observer) {
  std::optional<ArbOracle> oracle;
  const Module& module = preparation.module;
  if (module.rows == module.columns)
    settings.oracle =
        &oracle.emplace(module.find("matrix")->program, module.rows, search.precision);
  std::vector<Observer*> watching;
  if (observer != nullptr) watching.push_back(observer);
  std::optional<ProgressDisplay> display;
  if (!output.quiet && isatty(STDERR_FILENO) != 0) watching.push_back(&display.emplace(stderr));
  Observers observers(std::move(watching));
  const Result result = solve(preparation.problem(), settings, &observers);
  preparation.seconds.search = result.statistics.seconds;
  if (oracle) preparation.bits = oracle->bits();
  return result;
}

ExitCode exit_code_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNoSingularity:
      return kNoSingularity;
    case Verdict::kSingularity:
      return kSingularity;
    case Verdict::kPossibleProblem:
      return kPossibleProblem;
  }
  return kInternalFault;
}

}  // namespace regulus::codegen
