// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/closure_margin.hpp"

#include "codegen/answer/report/progress.hpp"
#include "codegen/question/closure/closure_certificate.hpp"
#include "codegen/question/engine/search_topic.hpp"
#include "codegen/support/stopwatch.hpp"
#include "codegen/support/time_budget.hpp"

namespace regulus {

MarginStep ClosureAttempts::at(const MarginValue& value, const PlannedAttempt& planned) {
  SearchOptions options = search_;
  if (planned.seconds < kInfinity) options.time_limit = TimeBudget::option(planned.seconds);
  if (planned.boxes < kAnyBoxes) options.max_boxes = planned.boxes;
  SearchDisplay display(output_);
  Stopwatch watch;
  FormingWatch forming;
  forming.interrupt = interrupt_;
  SearchTopic topic;
  topic.value = value.approx;
  turn_to(options.workers, std::move(topic), request_.nominal().motion);
  Checked checked{prepare_closure(request_.at(value), 0, options, forming), {}};
  checked.found = check_closure(checked.prepared, options, forming, display.observer());
  MarginStep step{value, check_result(checked.prepared, checked.found),
                  describe_claim(checked.prepared, checked.found)};
  step.result.statistics.seconds = watch.lap();
  certify(value, checked, step.result.verdict);
  if (step.result.verdict == Verdict::kSingularity)
    refuted_.emplace(std::move(checked));
  else
    last_.emplace(std::move(checked));
  return step;
}

void ClosureAttempts::certify(const MarginValue& value, const Checked& checked, Verdict verdict) {
  if (!proofs_.are_wanted() || verdict == Verdict::kPossibleProblem) return;
  const bool is_safe = verdict == Verdict::kNoSingularity;
  const ProofStatus written = is_safe ? certify_branch(proofs_.safe_file(), checked.prepared,
                                                       checked.found.searched, proofs_.placing())
                                      : certify_fold(proofs_.singular_file(), checked.prepared,
                                                     *checked.found.reached(), proofs_.placing());
  if (written.is_lost())
    is_safe ? proofs_.lose_safe(written.obstacle()) : proofs_.lose_singular(written.obstacle());
  else if (!written.is_written())
    is_safe ? proofs_.set_no_safe(written.obstacle()) : proofs_.set_no_singular(written.obstacle());
  else if (is_safe)
    proofs_.set_safe("safe at " + value.text);
  else
    proofs_.set_singular("singular at " + value.text);
}

}  // namespace regulus
