// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/search_run.hpp"

#include <algorithm>
#include <optional>

#include "codegen/question/engine/algebra_oracle.hpp"
#include "codegen/question/engine/arb_oracle.hpp"
#include "codegen/question/engine/closed_form_bounds.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/question/engine/witness_values.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/stopwatch.hpp"
#include "runtime/problem/observers.hpp"
#include "runtime/search/box_search.hpp"
#include "runtime/search/solver.hpp"
#include "runtime/witness/point_witness.hpp"

namespace regulus::detail {

namespace {

/// Runs a search with exact algebra; with more digits if there is a determinant.
template <class Search>
Result with_oracle(PreparedSearch& preparation, const SearchOptions& search, Settings& settings,
                   Search run) {
  std::optional<ArbOracle> oracle;
  ExactAlgebra algebra(preparation);
  if (preparation.matrix)
    settings.oracle =
        &oracle.emplace(*preparation.matrix, preparation.labels.rows, search.precision);
  const bool has_own_functions = !preparation.text;  // others than those of a text
  if (!preparation.stopped && has_own_functions) settings.algebra = &algebra;
  ClosedFormBounds closed_form(*preparation.stages);
  if (search.filters.empty() && has_own_functions) settings.closed_form = &closed_form;
  Result result = run();
  settings.closed_form = nullptr;
  if (oracle) preparation.bits = std::max(preparation.bits, oracle->bits());
  if (has_own_functions) enclose_determinants(preparation, result);
  return result;
}

/// `find(problem, settings, observers)` returns the state from which the search continues, or null.
/// `earlier`: seconds of earlier runs.
template <class Find>
Result run_from(PreparedSearch& preparation, const SearchOptions& search, Settings settings,
                Observer* observer, double earlier, const Find& find) {
  std::vector<Observer*> watching;
  if (observer != nullptr) watching.push_back(observer);
  if (preparation.late) watching.push_back(preparation.late.get());
  Observers observers(std::move(watching));
  const Problem problem = preparation.problem();
  const double before = preparation.stages->seconds();
  Stopwatch watch;
  const Method method = settings.method;
  if (preparation.stopped) {
    settings.time_limit = 0;
    settings.method = Method::kAuto;  // any other method needs its functions in the kernel
  }
  Result result = with_oracle(preparation, search, settings, [&] {
    Solver& solver = preparation.solver;
    const Checkpoint* const from = find(problem, settings, observers);
    if (from == nullptr) return solver.solve(problem, settings, &observers);
    return solver.resume(problem, settings, from->open(), from->state, &observers);
  });
  result.method = method;
  // The search has ended its own count when the stages serve its conclusion.
  const double spent_by_stages = preparation.stages->seconds() - before;
  preparation.seconds.search = earlier + std::max(0.0, watch.lap() - spent_by_stages);
  return result;
}

}  // namespace

double seconds_left(const PreparedSearch& preparation, double time_limit) {
  return std::max(0.0, time_limit - preparation.seconds_spent().before_search());
}

void set_limits(BoxSearchSettings& settings, const PreparedSearch& preparation,
                const SearchOptions& search, const std::atomic<bool>* interrupt) {
  settings.threads = settings_from(search).threads;
  if (search.max_boxes != 0) settings.max_boxes = search.max_boxes;
  if (search.time_limit != 0) settings.time_limit = seconds_left(preparation, search.time_limit);
  if (preparation.stopped) settings.time_limit = 0;
  settings.interrupt = interrupt;
  settings.workers = search.workers;
}

Result run_search(PreparedSearch& preparation, const SearchOptions& search, Settings settings,
                  Observer* observer, const Checkpoint* from) {
  const double earlier = from != nullptr ? from->state.statistics.seconds : 0;
  return run_from(preparation, search, settings, observer, earlier,
                  [from](const Problem&, Settings&, Observer&) { return from; });
}

Result continue_search(PreparedSearch& preparation, const SearchOptions& search, Settings settings,
                       Observer* observer, const Restore& restore) {
  Checkpoint from;
  return run_from(preparation, search, settings, observer, 0,
                  [&](const Problem& problem, Settings& of_search, Observer& observers) {
                    from = restore(problem, of_search, observers);
                    return &from;
                  });
}

Problem problem_of_another(const Problem& own, const cluster::SearchDescription& description) {
  Problem problem = description.problem;
  if (problem.outer.size() != own.outer.size() || problem.inner.size() != own.inner.size())
    throw InternalError("the ranks have prepared different questions");
  problem.kernel = own.kernel;
  problem.faster_kernel = own.faster_kernel;
  return problem;
}

void decide_for_another(PreparedSearch& preparation, const SearchOptions& search,
                        const cluster::SearchDescription& description,
                        const std::function<void(const Problem&, const Settings&)>& decide) {
  const Problem problem = problem_of_another(preparation.problem(), description);
  Settings settings = description.settings;
  if (const auto fault = find_fault(problem, settings))
    throw InternalError("the ranks have prepared different questions: " + *fault);
  static_cast<void>(with_oracle(preparation, search, settings, [&] {
    if (settings.closed_form != nullptr && settings.method == Method::kAuto)
      settings.closed_form->make();
    decide(problem, settings);
    return Result{};
  }));
}

Result prove_between(PreparedSearch& preparation, const SearchOptions& search, Settings settings,
                     std::span<const std::vector<double>> points) {
  return with_oracle(preparation, search, settings,
                     [&] { return prove_singularity(preparation.problem(), settings, points); });
}

void close_in_on_witness(PreparedSearch& preparation, const SearchOptions& search,
                         Settings settings, Result& result) {
  result = with_oracle(preparation, search, settings, [&] {
    Result closer = result;
    close_in(preparation.problem(), settings, closer);
    return closer;
  });
}

}  // namespace regulus::detail
