// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/conclusion.hpp"

#include <numeric>
#include <utility>

#include "runtime/witness/pose_search.hpp"
#include "runtime/witness/witness_search.hpp"

namespace regulus::detail {
namespace {

std::uint64_t leaves_of(const Statistics& statistics, Rule rule) noexcept {
  return statistics.leaves[static_cast<std::size_t>(rule)];
}

std::uint64_t all_leaves(const Statistics& statistics) noexcept {
  return std::accumulate(statistics.leaves.begin(), statistics.leaves.end(), std::uint64_t{0});
}

/// Returns true if the search was ended from outside: no time or memory is left for more work.
bool was_cut_short(const Result& result) noexcept {
  return result.stopped_by == Reason::kInterrupted || result.stopped_by == Reason::kTimeBudget ||
         result.stopped_by == Reason::kMemory || result.reason == Reason::kBadProblem;
}

void inhabit(Result& result, std::vector<Interval> point) {
  result.occupancy = Occupancy::kInhabited;
  result.inhabitant = std::move(point);
}

void find_occupancy(Result& result, const Problem& problem, const Settings& settings) {
  if (result.witness && !result.witness->points.empty())
    return inhabit(result, result.witness->points.front().variables);
  if (problem.kernel->constraints == 0) return inhabit(result, {});
  if (result.stopped_by) return;
  if (excluded_everywhere(result.statistics)) {
    result.occupancy = Occupancy::kEmpty;
    return;
  }
  Inhabitants found = find_pose(problem, settings);
  result.occupancy = found.occupancy;
  if (found.point) result.inhabitant = std::move(found.point->variables);
}

void note_that_all_is_singular(Result& result, WitnessPoint point) {
  point.determinant = Interval(0.0);
  result.verdict = Verdict::kSingularity;
  result.reason = Reason::kAlwaysSingular;
  result.blocking_box.clear();
  inhabit(result, point.variables);
  result.witness = Witness{{point}, point};
}

/// Returns true if nothing was proved, except perhaps that one point alone is singular.
bool may_be_singular_everywhere(const Result& result) noexcept {
  return result.verdict == Verdict::kPossibleProblem ||
         (result.verdict == Verdict::kSingularity && result.reason == Reason::kSmallDeterminant);
}

void ask_algebra(Result& result, const Problem& problem, const Settings& settings) {
  if (settings.algebra == nullptr || !may_be_singular_everywhere(result)) return;
  if (problem.kernel->rows != problem.kernel->columns || was_cut_short(result)) return;
  if (certified_somewhere(result.statistics)) return;
  Inhabitants found = find_defined_pose(problem, settings);
  if (!found.point) return;
  switch (settings.algebra->determinant(found.point->variables)) {
    case AlgebraOracle::Determinant::kVanishes:
      return note_that_all_is_singular(result, std::move(*found.point));
    case AlgebraOracle::Determinant::kSeemsToVanish:
      if (result.verdict == Verdict::kPossibleProblem && !result.stopped_by)
        result.reason = Reason::kSeemsSingular;
      return;
    case AlgebraOracle::Determinant::kUnknown:
      return;
  }
}

/// A singularity that is touched and not crossed, or a lost rank, has no change of sign. It may still
/// be at a place that is known exactly; a rank that is lost transversally is so in a small box.
void look_for_place(Result& result, const Problem& problem, const Settings& settings) {
  if (settings.algebra == nullptr || result.verdict != Verdict::kPossibleProblem) return;
  if (was_cut_short(result) || result.blocking_box.size() != problem.outer.size()) return;
  WitnessSearch search(problem, settings);
  search.look_for_exact_place(result.blocking_box);
  search.look_for_null_vector(result.blocking_box);
  if (!search.found()) return;
  result.verdict = Verdict::kSingularity;
  result.reason = search.reason();
  result.witness = search.witness();
  result.blocking_box.clear();
  inhabit(result, result.witness->points.front().variables);
}

}  // namespace

bool certified_somewhere(const Statistics& statistics) noexcept {
  return all_leaves(statistics) != leaves_of(statistics, Rule::kOutside) +
                                       leaves_of(statistics, Rule::kBlocked) +
                                       leaves_of(statistics, Rule::kWitness);
}

bool excluded_everywhere(const Statistics& statistics) noexcept {
  const std::uint64_t outside = leaves_of(statistics, Rule::kOutside);
  return outside > 0 && outside == all_leaves(statistics);
}

void complete(Result& result, const Problem& problem, const Settings& settings) {
  find_occupancy(result, problem, settings);
  if (result.occupancy == Occupancy::kEmpty) {
    result.verdict = Verdict::kPossibleProblem;
    result.reason = Reason::kEmptyVariety;
    result.blocking_box.clear();
    return;
  }
  ask_algebra(result, problem, settings);
  look_for_place(result, problem, settings);
}

}  // namespace regulus::detail
