// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/api/solve.hpp"

#include "codegen/answer/ask.hpp"
#include "codegen/support/stopwatch.hpp"
#include "codegen/use/api/algebra_lock.hpp"
#include "codegen/use/api/answer_fields.hpp"

namespace regulus {

using namespace detail;

namespace {

AskSolve asked_of(const Question& question, const SolveOptions& options) {
  ModelOptions model = question.options();
  model.at = options.at;
  return {std::move(model), options.search, options.hold};
}

/// What an answer tells to both findings.
template <class Finding>
void set_told(const SolveAnswer& answer, Stopwatch& watch, Finding& finding) {
  finding.headline = answer.headline();
  set_reports(answer, "", finding);
  finding.seconds = watch.lap();
}

}  // namespace

SolveFinding solve(const Question& question, const SolveOptions& options,
                   const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  Stopwatch watch;
  AskSolve asked = asked_of(question, options);
  asked.wanted = AskSolve::Places::kOne;
  const auto answer = ask(asked, services_of(options.certificate, options.shard_size, interrupt));
  SolveFinding finding;
  finding.solutions = answer->solutions;
  set_proof(answer->proof, finding);
  set_told(*answer, watch, finding);
  return finding;
}

SolveManyFinding solve_many(const Question& question, const Places& places,
                            const SolveOptions& options, const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  Stopwatch watch;
  AskSolve asked = asked_of(question, options);
  asked.wanted = AskSolve::Places::kMany;
  asked.places = places.numbers;
  asked.table = places.table;
  const auto answer = ask(asked, services_of(options.certificate, options.shard_size, interrupt));
  SolveManyFinding finding;
  finding.places = answer->places;
  finding.left = answer->places_left;
  set_proof(answer->proof, finding);
  set_told(*answer, watch, finding);
  return finding;
}

}  // namespace regulus
