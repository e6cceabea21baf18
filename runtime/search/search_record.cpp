// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/search_record.hpp"

#include <algorithm>
#include <utility>

#include "runtime/search/conclusion.hpp"

namespace regulus::detail {
namespace {

double seconds_since(SearchRecord::Clock::time_point start) noexcept {
  return std::chrono::duration<double>(SearchRecord::Clock::now() - start).count();
}

}  // namespace

SearchRecord::SearchRecord(const Problem& of, const Settings& with)
    : problem(of),
      settings(with),
      witness(of, with, !with.exhaustive),
      schedule(of, witness),
      frontier(of.kernel->variables),
      top_when_stopped_(of.kernel->variables) {}

/// Returns the time limit; a limit that no clock will reach means none.
SearchRecord::Clock::time_point SearchRecord::deadline() const noexcept {
  const std::chrono::duration<double> limit(settings.time_limit);
  if (!(limit < std::chrono::hours(24 * 365 * 100))) return Clock::time_point::max();
  return start_ + std::chrono::duration_cast<Clock::duration>(limit);
}

void SearchRecord::begin(std::span<const OpenBox> open, const SearchState& from,
                         const Bisector& bisector, Observer* to) {
  start_ = Clock::now();
  observer_ = to != nullptr ? to : &silent_;
  bisector_ = &bisector;
  stopped_ = false;
  stopped_by_.reset();
  frontier.clear();
  witness.restart();
  schedule.restart();
  state = from;
  state.filter_boxes.resize(settings.filters.size());
  state.blocking_box.resize(problem.kernel->variables);
  witness.look_on_from(state.candidates);
  witness.copy_candidates(state.candidates);
  probes_in_boxes = from.statistics.probes;
  seconds_before_ = from.statistics.seconds;
  observer_->on_start(problem, settings);
  for (std::size_t k = open.size(); k-- > 0;)
    if (!push_top(open[k])) stop_at_open_box(Reason::kMemory);
}

void SearchRecord::leave(const OpenBox& box, Rule rule, const Proof& proof) noexcept {
  ++state.statistics.leaves[static_cast<std::size_t>(rule)];
  state.headway.close(box.depth, rule);
  observer_->on_leaf(box, rule, proof);
}

void SearchRecord::block(const OpenBox& box, Reason reason, const Proof& proof) noexcept {
  leave(box, Rule::kBlocked, proof);
  if (!state.blocked) state.boxes_when_blocked = state.statistics.boxes;
  // Near a pole many boxes are too narrow to split; the undefined one shows the reason.
  if (!state.blocked || (reason == Reason::kUndefined && state.blocked_reason == Reason::kWidth)) {
    state.blocked = true;
    state.blocked_reason = reason;
    std::copy(box.box.begin(), box.box.end(), state.blocking_box.begin());
  }
  const std::uint64_t blocked = state.statistics.leaves[static_cast<std::size_t>(Rule::kBlocked)];
  if (!looking_for_witness()) return;
  schedule.look_in(box.box, blocked, state);
  stopped_ = stopped_ || witness.found();
}

BoxId SearchRecord::split(const OpenBox& parent, std::uint32_t variable, double at) noexcept {
  const BoxId first = state.next_id;
  observer_->on_split(parent, {parent.id, variable, at, first});
  state.next_id += 2;
  return first;
}

void SearchRecord::keep_witness(Decision& decision) noexcept {
  if (!decision.witness || state.witness) return;
  state.witness_reason = decision.reason;
  state.witness = std::move(decision.witness);
}

void SearchRecord::stop_at_open_box(Reason reason) noexcept {
  stopped_ = true;
  stopped_by_ = reason;
  if (!frontier.empty()) name_open_box(frontier.top().box);
}

void SearchRecord::name_open_box(std::span<const Interval> box) noexcept {
  std::copy(box.begin(), box.end(), top_when_stopped_.begin());
}

bool SearchRecord::must_stop(bool has_boxes) noexcept {
  if (settings.interrupt != nullptr && settings.interrupt->load(std::memory_order_relaxed))
    stop_at_open_box(Reason::kInterrupted);
  else if (!has_boxes)
    stop_at_open_box(Reason::kBoxBudget);
  else if (seconds_since(start_) >= settings.time_limit)
    stop_at_open_box(Reason::kTimeBudget);
  else if (state.blocked && !settings.exhaustive &&
           state.statistics.boxes - state.boxes_when_blocked >= settings.boxes_after_problem)
    stopped_ = true;
  else if (stalls())
    stop_at_open_box(Reason::kStalled);
  return stopped_;
}

bool SearchRecord::stalls() noexcept {
  return !settings.exhaustive && !state.blocked &&
         state.headway.stalls(state.statistics.boxes, bisector_->variables_to_split());
}

void SearchRecord::tell_progress(bool may_pause) noexcept {
  observer_->on_progress(state.statistics, frontier.size());
  if (may_pause && !stopped_ && !frontier.empty() && observer_->wants_pause()) pause();
}

void SearchRecord::pause() noexcept {
  count_up();
  observer_->on_pause(state, frontier);
}

void SearchRecord::tell_what_is_open() noexcept {
  if (!exhausted()) return;
  if (stopped_by_ != Reason::kMemory) pause();
  for (; !frontier.empty(); frontier.pop()) observer_->on_open(frontier.top());
}

/// Updates the counts that are only needed at intervals.
void SearchRecord::count_up() noexcept {
  Statistics& statistics = state.statistics;
  statistics.max_frontier = std::max<std::uint64_t>(statistics.max_frontier, frontier.max_size());
  statistics.probes = witness.probes() + probes_in_boxes;
  statistics.seconds = seconds_before_ + seconds_since(start_);
  witness.copy_candidates(state.candidates);
}

Result SearchRecord::conclude() {
  Result result;
  result.method = settings.method;
  result.stopped_by = stopped_by_;
  count_up();
  if (state.witness) {
    result.verdict = Verdict::kSingularity;
    result.reason = state.witness_reason;
    result.witness = state.witness;
  } else if (witness.found()) {
    result.verdict = Verdict::kSingularity;
    result.reason = witness.reason();
    result.witness = witness.witness();
  } else if (!state.blocked && !exhausted() && frontier.empty()) {
    result.verdict = Verdict::kNoSingularity;
    result.reason = Reason::kAllBoxesCertified;
  } else {
    result.verdict = Verdict::kPossibleProblem;
    result.reason = state.blocked ? state.blocked_reason : *stopped_by_;
    result.blocking_box = state.blocked ? state.blocking_box : top_when_stopped_;
  }
  result.statistics = state.statistics;
  result.filter_boxes = state.filter_boxes;
  complete(result, problem, settings);
  return result;
}

}  // namespace regulus::detail
