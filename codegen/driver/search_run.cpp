// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/search_run.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <optional>

#include "regulus/codegen/driver/algebra_oracle.hpp"
#include "regulus/codegen/driver/arb_oracle.hpp"
#include "regulus/codegen/driver/closed_form_bounds.hpp"
#include "regulus/codegen/driver/progress.hpp"
#include "regulus/search/observers.hpp"
#include "regulus/search/point_witness.hpp"
#include "regulus/search/solver.hpp"

namespace regulus::codegen {

namespace {

/// Runs a search with more digits and exact algebra at hand, where there is a determinant.
template <class Search>
Result with_oracle(Preparation& preparation, const SearchOptions& search, Settings& settings,
                   Search run) {
  std::optional<ArbOracle> oracle;
  ExactAlgebra algebra(preparation);
  if (preparation.matrix) {
    settings.oracle =
        &oracle.emplace(*preparation.matrix, preparation.subject.rows, search.precision);
    settings.algebra = &algebra;
  }
  ClosedFormBounds closed_form(*preparation.stages);
  if (search.filters.empty()) settings.closed_form = &closed_form;
  Result result = run();
  settings.closed_form = nullptr;
  if (oracle) preparation.bits = std::max(preparation.bits, oracle->bits());
  return result;
}

/// The compiler's work is kept for a later run, and nobody asked for an end.
bool is_worth_waiting(const Preparation& preparation, const Result& result) {
  return preparation.cache != name(CacheUse::kOff) &&
         (!result.stopped_by || *result.stopped_by == Reason::kBoxBudget ||
          *result.stopped_by == Reason::kStalled);
}

}  // namespace

double seconds_left(const Preparation& preparation, double time_limit) {
  const StageSeconds spent = preparation.seconds_spent();
  return std::max(0.0, time_limit - (spent.model + spent.symbolic + spent.emit + spent.compile));
}

Result run_search(Preparation& preparation, const SearchOptions& search,
                  const OutputOptions& output, Settings settings, Observer* observer,
                  const Checkpoint* from) {
  std::vector<Observer*> watching;
  if (observer != nullptr) watching.push_back(observer);
  std::optional<ProgressDisplay> display;
  if (!output.quiet && isatty(STDERR_FILENO) != 0) watching.push_back(&display.emplace(stderr));
  if (preparation.late) watching.push_back(preparation.late.get());
  Observers observers(std::move(watching));
  const Problem problem = preparation.problem();
  const double before = preparation.stages->seconds();
  const Method method = settings.method;
  if (preparation.stopped) {
    settings.time_limit = 0;
    settings.method = Method::kAuto;  // no other kernel is without the functions of its method
  }
  Result result = with_oracle(preparation, search, settings, [&] {
    return from != nullptr ? resume(problem, settings, from->open(), from->state, &observers)
                           : solve(problem, settings, &observers);
  });
  result.method = method;
  const double spent_by_stages = preparation.stages->seconds() - before;
  preparation.seconds.search = result.statistics.seconds - spent_by_stages;
  return result;
}

Result prove_between(Preparation& preparation, const SearchOptions& search, Settings settings,
                     std::span<const std::vector<double>> points) {
  return with_oracle(preparation, search, settings,
                     [&] { return prove_singularity(preparation.problem(), settings, points); });
}

void close_in_on_witness(Preparation& preparation, const SearchOptions& search, Settings settings,
                         Result& result) {
  result = with_oracle(preparation, search, settings, [&] {
    Result closer = result;
    close_in(preparation.problem(), settings, closer);
    return closer;
  });
}

ExitCode end_command(Preparation& preparation, const OutputOptions& output, const Result& result,
                     const std::atomic<bool>& interrupted) {
  const ExitCode code = exit_code_of(result.verdict);
  LateCompilation* const late = preparation.late.get();
  std::cout.flush();
  if (late == nullptr || !std::cout) return code;
  if (late->is_compiling() && !(is_worth_waiting(preparation, result) && late->wait(interrupted))) {
    std::fflush(nullptr);
    ::_exit(code);
  }
  if (!late->failure().empty() && !output.quiet)
    std::cerr << "compiler   none, and all was interpreted: " << late->failure() << '\n';
  return code;
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
