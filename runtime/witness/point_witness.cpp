// SPDX-License-Identifier: Apache-2.0
#include "runtime/witness/point_witness.hpp"

#include <chrono>

#include "runtime/kernel/rounding_scope.hpp"
#include "runtime/witness/witness_search.hpp"

namespace regulus::detail {
namespace {

/// Not inlined, so that no floating-point work moves out of the rounding scope of its caller.
[[gnu::noinline]] Result prove(const Problem& problem, const Settings& settings,
                               std::span<const std::vector<double>> points) {
  WitnessSearch search(problem, settings);
  search.look_at(points);
  Result result;
  result.method = settings.method;
  result.reason = Reason::kWidth;
  result.statistics.probes = search.probes();
  if (!search.found()) return result;
  result.verdict = Verdict::kSingularity;
  result.reason = search.reason();
  result.witness = search.witness();
  return result;
}

}  // namespace

Result prove_singularity(const Problem& problem, const Settings& settings,
                         std::span<const std::vector<double>> points) {
  const auto start = std::chrono::steady_clock::now();
  const RoundingScope scope(REGULUS_ROUND_NEAREST);
  Result result = prove(problem, settings, points);
  result.statistics.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

void close_in(const Problem& problem, const Settings& settings, Result& result) {
  if (!result.witness || result.witness->near) return;
  std::vector<std::vector<double>> points;
  for (const WitnessPoint& point : result.witness->points) {
    points.emplace_back();
    for (const Interval& x : point.variables) points.back().push_back(mid(x));
  }
  Settings inclusive = settings;
  inclusive.exhaustive = false;
  const Result closer = prove_singularity(problem, inclusive, points);
  if (closer.verdict != Verdict::kSingularity) return;
  result.reason = closer.reason;
  result.witness = closer.witness;
}

}  // namespace regulus::detail
