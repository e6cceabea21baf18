// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "regulus/codegen/driver/arb_oracle.hpp"
#include "regulus/codegen/driver/commands.hpp"
#include "regulus/codegen/driver/exit_code.hpp"
#include "regulus/codegen/driver/interrupt.hpp"
#include "regulus/codegen/driver/pipeline.hpp"
#include "regulus/codegen/driver/progress.hpp"
#include "regulus/codegen/driver/report.hpp"
#include "regulus/codegen/driver/settings.hpp"
#include "regulus/search/solver.hpp"

namespace regulus::codegen {
namespace {

int exit_code(Verdict verdict) {
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

Result search(Preparation& preparation, const CheckCommand& command,
              const std::atomic<bool>& interrupt) {
  Settings settings = settings_from(command.search);
  settings.interrupt = &interrupt;
  std::optional<ArbOracle> oracle;
  const Module& module = preparation.module;
  if (module.rows == module.columns)
    settings.oracle =
        &oracle.emplace(module.find("matrix")->program, module.rows, command.search.precision);
  std::optional<ProgressDisplay> display;
  if (!command.output.quiet && isatty(STDERR_FILENO) != 0) display.emplace(stderr);
  const Result result = solve(preparation.problem(), settings, display ? &*display : nullptr);
  preparation.seconds.search = result.statistics.seconds;
  if (oracle) preparation.bits = oracle->bits();
  return result;
}

}  // namespace

int run_check(const CheckCommand& command) {
  const InterruptGuard interrupt;
  Preparation preparation = prepare(command.model, command.search);
  const Result result = search(preparation, command, interrupt.requested());
  if (!command.output.quiet) std::cerr << text_report(preparation, command.search, result);
  if (command.output.json)
    std::cout << json_report(preparation, command.search, result).dump(2) << '\n';
  else
    std::cout << name(result.verdict) << '\n';
  std::cout.flush();
  return exit_code(result.verdict);
}

}  // namespace regulus::codegen
