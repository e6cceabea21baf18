// SPDX-License-Identifier: Apache-2.0
// run_search() is in another file, so that no floating-point work moves out of the rounding scope.
#include <algorithm>

#include "runtime/kernel/rounding_scope.hpp"
#include "runtime/search/run_search.hpp"
#include "runtime/search/solver.hpp"

namespace regulus {
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

}  // namespace

Result resume(const Problem& problem, const Settings& settings, std::span<const OpenBox> open,
              const SearchState& state, Observer* observer) {
  if (find_fault(problem, settings)) return faulty(settings);
  for (const OpenBox& box : open)
    if (!keeps_ranges(problem, settings, box)) return faulty(settings);
  const RoundingScope scope(REGULUS_ROUND_NEAREST);
  return run_search(problem, settings, open, state, observer);
}

Result solve(const Problem& problem, const Settings& settings, Observer* observer) {
  const OpenBox root{0, 0, problem.outer};
  return resume(problem, settings, {&root, 1}, {}, observer);
}

}  // namespace regulus
