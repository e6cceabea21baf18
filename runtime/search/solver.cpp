// SPDX-License-Identifier: Apache-2.0
// The search itself is in another file, so that no floating-point work moves out of the rounding
// scope.
#include "runtime/search/solver.hpp"

#include <algorithm>

#include "runtime/kernel/rounding_scope.hpp"
#include "runtime/search/search.hpp"

namespace regulus {

using namespace detail;

namespace {

Result faulty(const Settings& settings) {
  Result result;
  result.method = settings.method;
  result.reason = Reason::kBadProblem;
  return result;
}

/// Returns true if uncertain quantities that are kept whole have their whole range in the box.
bool keeps_ranges(const Problem& problem, const Settings& settings, const OpenBox& open) noexcept {
  if (open.box.size() != problem.outer.size()) return false;
  if (settings.uncertainty == Uncertainty::kVariables) return true;
  const std::size_t first = problem.kernel->motion_variables;
  return std::equal(open.box.begin() + static_cast<std::ptrdiff_t>(first), open.box.end(),
                    problem.outer.begin() + static_cast<std::ptrdiff_t>(first));
}

/// Of problems without faults.
bool same_but_for_ranges(const Problem& a, const Problem& b) {
  Problem with_ranges = a;
  with_ranges.outer = b.outer;
  with_ranges.inner = b.inner;
  return with_ranges == b;
}

}  // namespace

/// The search refers to the copies, so that it sees new budgets and oracles.
struct Solver::Kept {
  Kept(const Problem& of, const Settings& with)
      : problem(of), settings(with), search(problem, settings) {}

  Problem problem;
  Settings settings;
  Search search;
};

Solver::Solver() noexcept = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;
Solver::~Solver() = default;

/// Returns the kept search if only ranges have changed, or members that it reads anew in each run.
Search& Solver::search_for(const Problem& problem, const Settings& settings) {
  const bool fits = kept_ != nullptr && same_but_for_ranges(kept_->problem, problem) &&
                    same_but_for_run(kept_->settings, settings);
  if (fits) {
    kept_->settings = settings;
    if (!(kept_->problem == problem)) take_ranges(problem);
  } else {
    keep(std::make_unique<Kept>(problem, settings));
  }
  return kept_->search;
}

/// The search refers to the kept problem, which therefore stays where it is.
void Solver::take_ranges(const Problem& problem) try {
  std::ranges::copy(problem.outer, kept_->problem.outer.begin());
  std::ranges::copy(problem.inner, kept_->problem.inner.begin());
  kept_->search.take_ranges();
} catch (...) {
  kept_.reset();
  throw;
}

/// Searches of one robot resemble each other.
void Solver::keep(std::unique_ptr<Kept> next) noexcept {
  if (kept_ != nullptr && kept_->problem.kernel->variables == next->problem.kernel->variables)
    next->search.learn_from(kept_->search);
  kept_ = std::move(next);
}

Result Solver::resume(const Problem& problem, const Settings& settings,
                      std::span<const OpenBox> open, const SearchState& state, Observer* observer) {
  if (find_fault(problem, settings)) return faulty(settings);
  for (const OpenBox& box : open)
    if (!keeps_ranges(problem, settings, box)) return faulty(settings);
  const RoundingScope scope(REGULUS_ROUND_NEAREST);
  return search_for(problem, settings).run(open, state, observer);
}

Result Solver::solve(const Problem& problem, const Settings& settings, Observer* observer) {
  const OpenBox root{0, 0, problem.outer};
  return resume(problem, settings, {&root, 1}, {}, observer);
}

Result resume(const Problem& problem, const Settings& settings, std::span<const OpenBox> open,
              const SearchState& state, Observer* observer) {
  return Solver().resume(problem, settings, open, state, observer);
}

Result solve(const Problem& problem, const Settings& settings, Observer* observer) {
  return Solver().solve(problem, settings, observer);
}

}  // namespace regulus
