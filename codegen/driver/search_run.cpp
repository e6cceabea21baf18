// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/search_run.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "regulus/codegen/driver/arb_oracle.hpp"
#include "regulus/codegen/driver/progress.hpp"
#include "regulus/search/observers.hpp"
#include "regulus/search/point_witness.hpp"
#include "regulus/search/solver.hpp"

namespace regulus::codegen {

namespace {

/// More digits for the determinants of a preparation, where it has any, as long as this lives.
class OracleGuard {
 public:
  OracleGuard(Preparation& preparation, const SearchOptions& search, Settings& settings)
      : preparation_(preparation) {
    const Module& module = preparation.module;
    if (module.rows != module.columns) return;
    settings.oracle =
        &oracle_.emplace(module.find("matrix")->program, module.rows, search.precision);
  }
  OracleGuard(const OracleGuard&) = delete;
  OracleGuard& operator=(const OracleGuard&) = delete;
  ~OracleGuard() {
    if (oracle_) preparation_.bits = std::max(preparation_.bits, oracle_->bits());
  }

 private:
  Preparation& preparation_;
  std::optional<ArbOracle> oracle_;
};

}  // namespace

Result run_search(Preparation& preparation, const SearchOptions& search,
                  const OutputOptions& output, Settings settings, Observer* observer,
                  const Checkpoint* from) {
  const OracleGuard oracle(preparation, search, settings);
  std::vector<Observer*> watching;
  if (observer != nullptr) watching.push_back(observer);
  std::optional<ProgressDisplay> display;
  if (!output.quiet && isatty(STDERR_FILENO) != 0) watching.push_back(&display.emplace(stderr));
  Observers observers(std::move(watching));
  const Problem problem = preparation.problem();
  const Result result = from != nullptr
                            ? resume(problem, settings, from->open(), from->state, &observers)
                            : solve(problem, settings, &observers);
  preparation.seconds.search = result.statistics.seconds;
  return result;
}

Result prove_between(Preparation& preparation, const SearchOptions& search, Settings settings,
                     std::span<const std::vector<double>> points) {
  const OracleGuard oracle(preparation, search, settings);
  return prove_singularity(preparation.problem(), settings, points);
}

void close_in_on_witness(Preparation& preparation, const SearchOptions& search, Settings settings,
                         Result& result) {
  if (!result.witness || result.witness->near) return;
  std::vector<std::vector<double>> points;
  for (const WitnessPoint& point : result.witness->points) {
    points.emplace_back();
    for (const Interval& x : point.variables) points.back().push_back(mid(x));
  }
  settings.exhaustive = false;
  const Result closer = prove_between(preparation, search, settings, points);
  if (closer.verdict != Verdict::kSingularity) return;
  result.reason = closer.reason;
  result.witness = closer.witness;
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
