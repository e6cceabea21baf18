// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/path_attempts.hpp"

#include <utility>

#include "codegen/answer/report/progress.hpp"
#include "codegen/question/way/trajectory_certificate.hpp"
#include "codegen/question/way/trajectory_report.hpp"
#include "codegen/support/stopwatch.hpp"
#include "codegen/support/time_budget.hpp"

namespace regulus::detail {
namespace {

/// True if the searches did not come to their own ends.
bool is_stop(Reason reason) {
  return reason == Reason::kTimeBudget || reason == Reason::kInterrupted ||
         reason == Reason::kBoxBudget || reason == Reason::kMemory;
}

MarginStep step_of(const MarginValue& value, const TrajectoryCheck& check, double seconds) {
  MarginStep step{value, {}, describe_trajectory_claim(check)};
  Result& result = step.result;
  result.verdict = check.verdict;
  result.reason = check.reason;
  result.statistics = check.path.statistics;
  result.statistics.seconds = seconds;
  if (is_stop(check.reason)) result.stopped_by = check.reason;
  if (check.reason == Reason::kEmptyVariety) result.occupancy = Occupancy::kEmpty;
  return step;
}

}  // namespace

PathAttempts::PathAttempts(const MarginRequest& request, SearchOptions search,
                           const OutputOptions& output, const std::atomic<bool>* interrupt,
                           EndProofs proofs, SearchTopic topic)
    : request_(request),
      search_(std::move(search)),
      output_(output),
      interrupt_(interrupt),
      proofs_(std::move(proofs)),
      topic_(std::move(topic)) {}

MarginStep PathAttempts::at(const MarginValue& value, const PlannedAttempt& planned) {
  SearchOptions options = search_;
  if (planned.seconds < kInfinity) options.time_limit = TimeBudget::option(planned.seconds);
  if (planned.boxes < kAnyBoxes) options.max_boxes = planned.boxes;
  SearchDisplay display(output_);
  Stopwatch watch;
  topic_.value = value.approx;
  TrajectoryCheck check = check_trajectory(request_.at(value), 0, options, proofs_.are_wanted(),
                                           {interrupt_, display.observer(), nullptr, topic_});
  MarginStep step = step_of(value, check, watch.lap());
  seconds_ += check.seconds;
  certify(value, check);
  (check.verdict == Verdict::kSingularity ? refuted_ : last_) = std::move(check);
  return step;
}

void PathAttempts::certify(const MarginValue& value, const TrajectoryCheck& check) {
  if (!proofs_.are_wanted() || check.verdict == Verdict::kPossibleProblem) return;
  const bool is_singular = check.verdict == Verdict::kSingularity;
  const ProofStatus written =
      certify_trajectory(is_singular ? proofs_.singular_file() : proofs_.safe_file(), check,
                         request_.certified_at(value), proofs_.placing());
  proofs_.note(!is_singular, written, value.text);
}

Bracket::Limits limits_of(const SearchOptions& search, double gap) {
  return {gap, search.time_limit == 0 ? kInfinity : search.time_limit,
          search.max_boxes == 0 ? kAnyBoxes : search.max_boxes};
}

}  // namespace regulus::detail
