// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/api/solve.hpp"

#include "codegen/answer/ask.hpp"
#include "codegen/support/stopwatch.hpp"
#include "codegen/use/api/algebra_lock.hpp"
#include "codegen/use/api/answer_fields.hpp"

namespace regulus {

SolveFinding solve(const Question& question, const SolveOptions& options,
                   const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  Stopwatch watch;
  ModelOptions model = question.options();
  model.at = options.at;
  const auto answer =
      ask(AskSolve{std::move(model), options.search, options.hold}, services_of("", 0, interrupt));
  SolveFinding finding;
  finding.solutions = answer->solutions;
  finding.headline = answer->headline();
  set_reports(*answer, "", finding);
  finding.seconds = watch.lap();
  return finding;
}

}  // namespace regulus
