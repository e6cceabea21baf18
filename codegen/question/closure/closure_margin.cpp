// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/closure_margin.hpp"

#include "codegen/answer/report/progress.hpp"
#include "codegen/question/closure/closure_certificate.hpp"
#include "codegen/question/closure/closure_claims.hpp"
#include "codegen/question/closure/closure_way_report.hpp"
#include "codegen/question/engine/search_topic.hpp"
#include "codegen/support/stopwatch.hpp"
#include "codegen/support/time_budget.hpp"

namespace regulus::detail {

CheckedBranch::CheckedBranch(Request request, const SearchOptions& search,
                             const FormingWatch& watch, Observer* progress,
                             const SearchTopic& topic)
    : prepared(prepare_closure(std::move(request), 0, search, watch)),
      found(check_closure(prepared, search, watch, {progress, topic, {}})) {}

Result CheckedBranch::result() const { return check_result(prepared, found); }

std::string CheckedBranch::claim() const { return describe_claim(prepared, found); }

ProofStatus CheckedBranch::certify(const std::string& path, const ProofPlacing& placing) const {
  return certify_check(path, prepared, found, placing);
}

CheckedBranchOnWay::CheckedBranchOnWay(Request request, const SearchOptions& search,
                                       const FormingWatch& watch, Observer* progress,
                                       const SearchTopic& topic)
    : prepared(prepare_way(std::move(request), 0, search, watch)),
      found(check_way(prepared, search, watch, {progress, topic, {}})) {}

std::string CheckedBranchOnWay::claim() const { return describe_claim(prepared, found); }

ProofStatus CheckedBranchOnWay::certify(const std::string& path,
                                        const ProofPlacing& placing) const {
  return certify_way(path, prepared, found, placing);
}

template <class Checked>
MarginStep ClosureAttempts<Checked>::at(const MarginValue& value, const PlannedAttempt& planned) {
  SearchOptions options = search_;
  if (planned.seconds < kInfinity) options.time_limit = TimeBudget::option(planned.seconds);
  if (planned.boxes < kAnyBoxes) options.max_boxes = planned.boxes;
  SearchDisplay display(output_);
  Stopwatch watch;
  FormingWatch forming;
  forming.interrupt = interrupt_;
  SearchTopic topic;
  topic.value = value.approx;
  Checked checked(request_.at(value), options, forming, display.observer(), topic);
  MarginStep step{value, checked.result(), checked.claim()};
  step.result.statistics.seconds = watch.lap();
  certify(value, checked, step.result.verdict);
  if (step.result.verdict == Verdict::kSingularity)
    refuted_.emplace(std::move(checked));
  else
    last_.emplace(std::move(checked));
  return step;
}

template <class Checked>
void ClosureAttempts<Checked>::certify(const MarginValue& value, const Checked& checked,
                                       Verdict verdict) {
  if (!proofs_.are_wanted() || verdict == Verdict::kPossibleProblem) return;
  const bool is_safe = verdict == Verdict::kNoSingularity;
  const std::string file = is_safe ? proofs_.safe_file() : proofs_.singular_file();
  proofs_.note(is_safe, checked.certify(file, proofs_.placing()), value.text);
}

template class ClosureAttempts<CheckedBranch>;
template class ClosureAttempts<CheckedBranchOnWay>;

}  // namespace regulus::detail
