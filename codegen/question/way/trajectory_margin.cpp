// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/trajectory_margin.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "codegen/question/margin/margin_report.hpp"
#include "codegen/question/way/trajectory_report.hpp"
#include "codegen/support/stopwatch.hpp"

namespace regulus {
namespace {

MarginValue value_of(const MarginQuestion& question, double planned) {
  if (planned == question.low.approx) return question.low;
  if (question.high && planned == question.high->approx) return *question.high;
  return decimal_value(planned);
}

double end_of(const MarginQuestion& question) {
  return question.high ? question.high->approx : kInfinity;
}

MarginStep step_of(const MarginValue& value, const TrajectoryCheck& check, double seconds) {
  MarginStep step{value, {}, describe_trajectory_claim(check)};
  step.result.verdict = check.verdict;
  step.result.reason = check.reason;
  step.result.statistics = check.path.statistics;
  step.result.statistics.seconds = seconds;
  return step;
}

void keep(Margin& margin, const MarginStep& step) {
  margin.seconds += step.result.statistics.seconds;
  margin.boxes += step.result.statistics.boxes;
  if (step.result.verdict == Verdict::kNoSingularity) margin.certified = step;
  if (step.result.verdict == Verdict::kSingularity) margin.refuted = step;
  if (step.result.reason == Reason::kEmptyVariety) margin.empty = step;
  margin.steps.push_back(step);
}

}  // namespace

TrajectoryMargin margin_of_trajectory(const MarginRequest& request, const MarginQuestion& question,
                                      const SearchOptions& search, double gap,
                                      const PathWatch& watch, const MarginRun::Listener& listener) {
  const double limit = search.time_limit == 0 ? kInfinity : search.time_limit;
  const std::uint64_t most = search.max_boxes == 0 ? kAnyBoxes : search.max_boxes;
  Bracket bracket(question.low.approx, end_of(question), {gap, limit, most});
  TrajectoryMargin found;
  while (!watch.is_interrupted()) {
    const std::optional<PlannedAttempt> planned = bracket.next();
    if (!planned) break;
    const MarginValue value = value_of(question, planned->value);
    SearchOptions options = search;
    if (planned->seconds < kInfinity) options.time_limit = planned->seconds;
    if (planned->boxes < kAnyBoxes) options.max_boxes = planned->boxes;
    Stopwatch stopwatch;
    TrajectoryCheck check = check_trajectory(request.at(value), 0, options, false, watch);
    const MarginStep step = step_of(value, check, stopwatch.lap());
    bracket.note({step.value.approx, step.result.verdict, step.result.reason,
                  step.result.statistics.boxes, step.result.statistics.seconds, planned->boxes});
    keep(found.margin, step);
    listener(step);
    const bool is_refuted = check.verdict == Verdict::kSingularity;
    (is_refuted ? found.refuted.emplace() : found.last) = std::move(check);
  }
  if (found.margin.certified) found.margin.gap = bracket.gap();
  found.margin.closed = bracket.closed();
  found.margin.interrupted = watch.is_interrupted();
  return found;
}

void tell_trajectory_margin(const TrajectoryMargin& found, const MarginQuestion& question,
                            const SearchOptions& search, double gap, Facts& facts) {
  const Margin& margin = found.margin;
  tell_trajectory_question(found.refuted ? *found.refuted : found.last, search, facts);
  facts.say("margin", fmt::format("{}: {} boxes at {} values", describe_range(question),
                                  margin.boxes, margin.steps.size()));
  add_bracket(question, margin, facts);
  for (const auto* step : {&margin.empty, &margin.certified, &margin.refuted})
    say_end(*step, facts);
  facts.add("segment", nullptr).add("witness", nullptr);
  if (found.refuted) tell_deciding_piece(*found.refuted, facts);
  tell_gap(margin, gap, facts);
}

}  // namespace regulus
