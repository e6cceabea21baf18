// SPDX-License-Identifier: Apache-2.0
// Algorithm 1 on up to eight boxes at a time, with the constraints of Table II.
//
// A box leaves the search for one of three reasons: a constraint excludes it, a test certifies
// it, or it cannot be decided and must not be split any more. The last kind rules out NO
// SINGULARITY; the search then continues for a while, widest boxes first, since SINGULARITY may
// still be shown. An exhaustive search decides all boxes, and searches for a singularity inside
// each that remains.
#include <algorithm>
#include <chrono>
#include <utility>

#include "runtime/search/branch_and_prune.hpp"
#include "runtime/search/conclusion.hpp"
#include "runtime/search/frontier.hpp"
#include "runtime/search/headway.hpp"
#include "runtime/search/round.hpp"
#include "runtime/search/run_search.hpp"
#include "runtime/search/witness_schedule.hpp"
#include "runtime/witness/witness_search.hpp"

namespace regulus {
namespace {

using Clock = std::chrono::steady_clock;

/// A round has one more batch for each so many boxes that were evaluated before. So a search that
/// ends early does little extra work, and a long one keeps its threads busy.
constexpr std::uint64_t kBoxesABatch = 64;
constexpr std::uint64_t kMaxBatches = 64;

/// After so many boxes, the determinant in closed form is worth the time that forming it takes.
constexpr std::uint64_t kBoxesBeforeClosedForm = 256;

class Search {
 public:
  Search(const Problem& problem, const Settings& settings, Observer* observer)
      : problem_(problem),
        settings_(settings),
        observer_(observer != nullptr ? *observer : silent_),
        structure_(find_row_structure(problem, settings)),
        round_(problem, settings, structure_, deadline()),
        witness_(problem, settings, !settings.exhaustive),
        schedule_(problem, witness_),
        frontier_(problem.kernel->variables),
        loop_(*this, frontier_, round_.bisector(), problem.kernel->variables),
        top_when_stopped_(problem.kernel->variables) {}

  Result run(std::span<const OpenBox> open, const SearchState& state);

 private:
  friend class BranchAndPrune<Search>;
  [[nodiscard]] bool begin_round() noexcept;
  [[nodiscard]] std::size_t decide_round() noexcept;
  [[nodiscard]] Decisions& batch(std::size_t index) noexcept { return round_.batch(index); }
  [[nodiscard]] bool conclude(Decisions& batch) noexcept;
  [[nodiscard]] bool goes_on() const noexcept { return !witness_.found(); }
  void give_back(Decisions& batch) noexcept;
  void settle(Decisions& batch, std::size_t lane) noexcept;
  [[nodiscard]] bool splits(const OpenBox& box) noexcept;
  [[nodiscard]] BoxId number(const OpenBox& parent, std::uint32_t variable, double at) noexcept;
  void lose(const OpenBox& first, const OpenBox& second) noexcept;
  void end_round() noexcept;

  void stop_at_undecided_batch() noexcept;
  [[nodiscard]] bool must_stop() noexcept;
  [[nodiscard]] std::uint64_t batches_of_round() const noexcept;
  [[nodiscard]] bool has_budget_for_round() const noexcept;
  [[nodiscard]] bool stalls() noexcept;
  void make_closed_form() noexcept;
  void stop_at_open_box(Reason reason) noexcept;

  void load_round() noexcept;
  void load(Decisions& batch) noexcept;
  void leave(const Decisions& batch, std::size_t lane) noexcept;
  void block(Decisions& batch, std::size_t lane) noexcept;
  void pause() noexcept;
  void count_up() noexcept;
  [[nodiscard]] Result conclude();

  [[nodiscard]] Clock::time_point deadline() const noexcept;
  [[nodiscard]] bool looking_for_witness() const noexcept {
    return !settings_.exhaustive && !witness_.found();
  }

  Observer silent_;
  const Problem& problem_;
  const Settings& settings_;
  Observer& observer_;
  const Clock::time_point start_ = Clock::now();
  const RowStructure structure_;
  Round round_;
  WitnessSearch witness_;
  WitnessSchedule schedule_;
  Frontier frontier_;
  BranchAndPrune<Search> loop_;
  SearchState state_;
  std::vector<Interval> top_when_stopped_;
  bool stopped_ = false;
  bool exhausted_ = false;  ///< stopped by a budget or from outside, not by a verdict
  std::optional<Reason> stopped_by_;
  std::uint64_t probes_in_boxes_ = 0;
  double seconds_before_ = 0;
  bool closed_form_made_ = false;
  Headway headway_;
};

double seconds_since(Clock::time_point start) noexcept {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Returns the time limit; a limit that no clock will reach means none.
Clock::time_point Search::deadline() const noexcept {
  const std::chrono::duration<double> limit(settings_.time_limit);
  if (!(limit < std::chrono::hours(24 * 365 * 100))) return Clock::time_point::max();
  return start_ + std::chrono::duration_cast<Clock::duration>(limit);
}

Result Search::run(std::span<const OpenBox> open, const SearchState& state) {
  state_ = state;
  state_.filter_boxes.resize(settings_.filters.size());
  state_.blocking_box.resize(problem_.kernel->variables);
  witness_.look_on_from(state_.candidates);
  witness_.copy_candidates(state_.candidates);
  probes_in_boxes_ = state.statistics.probes;
  seconds_before_ = state.statistics.seconds;
  headway_.begin(state.statistics.boxes);
  observer_.on_start(problem_, settings_);
  for (std::size_t k = open.size(); k-- > 0;)
    if (!frontier_.push_top(open[k], round_.bisector().approx_relative_width(open[k].box)))
      stop_at_open_box(Reason::kMemory);
  loop_.run();
  if (exhausted_) {
    if (stopped_by_ != Reason::kMemory) pause();
    for (; !frontier_.empty(); frontier_.pop()) observer_.on_open(frontier_.top());
  }
  Result result = conclude();
  observer_.on_finish(result);
  return result;
}

bool Search::begin_round() noexcept { return !stopped_ && !must_stop(); }

std::size_t Search::decide_round() noexcept {
  make_closed_form();
  load_round();
  if (!round_.decide(state_.threshold)) stop_at_undecided_batch();
  return round_.size();
}

/// Memory is exhausted. The results of the other batches count; these boxes are given back.
void Search::stop_at_undecided_batch() noexcept {
  stop_at_open_box(Reason::kMemory);
  for (std::size_t i = round_.size(); i-- > 0;) {
    if (round_.batch(i).decided) continue;
    const std::span<const Interval> box = round_.batch(i).box_of(0);
    std::copy(box.begin(), box.end(), top_when_stopped_.begin());
  }
}

void Search::end_round() noexcept {
  observer_.on_progress(state_.statistics, frontier_.size());
  if (!stopped_ && !frontier_.empty() && observer_.wants_pause()) pause();
}

void Search::pause() noexcept {
  count_up();
  observer_.on_pause(state_, frontier_);
}

/// Updates the counts that are only needed at intervals.
void Search::count_up() noexcept {
  Statistics& statistics = state_.statistics;
  statistics.max_frontier = std::max<std::uint64_t>(statistics.max_frontier, frontier_.max_size());
  statistics.probes = witness_.probes() + probes_in_boxes_;
  statistics.seconds = seconds_before_ + seconds_since(start_);
  witness_.copy_candidates(state_.candidates);
}

bool Search::must_stop() noexcept {
  if (settings_.interrupt != nullptr && settings_.interrupt->load(std::memory_order_relaxed))
    stop_at_open_box(Reason::kInterrupted);
  else if (!has_budget_for_round())
    stop_at_open_box(Reason::kBoxBudget);
  else if (seconds_since(start_) >= settings_.time_limit)
    stop_at_open_box(Reason::kTimeBudget);
  else if (state_.blocked && !settings_.exhaustive &&
           state_.statistics.boxes - state_.boxes_when_blocked >= settings_.boxes_after_problem)
    stopped_ = true;
  else if (stalls())
    stop_at_open_box(Reason::kStalled);
  return stopped_;
}

/// Leaves from before a checkpoint do not count: the count begins again.
bool Search::stalls() noexcept {
  return !settings_.exhaustive && !state_.blocked &&
         headway_.stalls(state_.statistics.boxes, round_.bisector().variables_to_split());
}

void Search::make_closed_form() noexcept {
  if (closed_form_made_ || settings_.closed_form == nullptr) return;
  if (settings_.method != Method::kAuto || state_.statistics.boxes < kBoxesBeforeClosedForm) return;
  closed_form_made_ = true;
  settings_.closed_form->make();
}

void Search::stop_at_open_box(Reason reason) noexcept {
  stopped_ = exhausted_ = true;
  stopped_by_ = reason;
  if (frontier_.empty()) return;
  const OpenBox top = frontier_.top();
  std::copy(top.box.begin(), top.box.end(), top_when_stopped_.begin());
}

/// The order of the paper needs one box at a time.
std::uint64_t Search::batches_of_round() const noexcept {
  if (settings_.batch == 1) return 1;
  return std::min(1 + state_.statistics.boxes / kBoxesABatch, kMaxBatches);
}

/// A budget ends a search between two rounds, never within one. The boxes of a round decide which
/// come next. So a continued search takes the same boxes as a search without a stop.
bool Search::has_budget_for_round() const noexcept {
  const std::uint64_t boxes = state_.statistics.boxes, size = frontier_.size();
  const std::uint64_t next = std::min(batches_of_round() * settings_.batch, size);
  return boxes <= settings_.max_boxes && next <= settings_.max_boxes - boxes;
}

void Search::load_round() noexcept {
  const std::uint64_t most = batches_of_round();
  round_.clear();
  while (round_.size() < most && !frontier_.empty()) {
    Decisions* batch = round_.append();
    if (batch == nullptr) break;
    load(*batch);
  }
  if (round_.size() == 0) stop_at_open_box(Reason::kMemory);
}

void Search::load(Decisions& batch) noexcept {
  // If NO SINGULARITY is not possible any more, the widest boxes show most of the rest.
  const bool from_end = state_.blocked && !settings_.exhaustive;
  while (batch.count() < settings_.batch && !frontier_.empty()) {
    batch.add(from_end ? frontier_.end() : frontier_.top());
    from_end ? frontier_.pop_end() : frontier_.pop();
    ++state_.statistics.boxes;
  }
}

/// Gives back a batch that was not decided because the search must stop.
void Search::give_back(Decisions& batch) noexcept {
  for (std::size_t lane = batch.count(); lane-- > 0; --state_.statistics.boxes) {
    const OpenBox& box = batch.open(lane);
    if (frontier_.push_top(box, round_.bisector().approx_relative_width(box.box))) continue;
    stop_at_open_box(Reason::kMemory);
    observer_.on_open(box);
  }
}

bool Search::conclude(Decisions& batch) noexcept {
  if (!batch.decided) return true;
  for (std::size_t t = 0; t < batch.budget.trials; ++t)
    state_.threshold.learn(batch.budget.trial[t]);
  probes_in_boxes_ += batch.probes;
  for (std::size_t lane = 0; lane < batch.count(); ++lane) {
    Decision& decision = batch.decision[lane];
    if (decision.kind != Decision::Kind::kLeaf || decision.rule == Rule::kBlocked) continue;
    if (decision.rule == Rule::kFilter) ++state_.filter_boxes[decision.filter];
    leave(batch, lane);
    // Moved, which needs no memory: the batch does not need it any more.
    if (decision.witness && !state_.witness)
      state_.witness_reason = decision.reason, state_.witness = std::move(decision.witness);
  }
  if (settings_.exhaustive) return true;
  witness_.look_at_midpoints(batch);
  if (looking_for_witness()) schedule_.look_after(batch, state_);
  stopped_ = stopped_ || witness_.found();
  return !witness_.found();
}

void Search::leave(const Decisions& batch, std::size_t lane) noexcept {
  const Rule rule = batch.decision[lane].rule;
  ++state_.statistics.leaves[static_cast<std::size_t>(rule)];
  headway_.close(batch.open(lane).depth, rule);
  observer_.on_leaf(batch.open(lane), rule, batch.proof(lane));
}

bool Search::splits(const OpenBox& box) noexcept {
  if (exhausted_) observer_.on_open(box);
  return !exhausted_;
}

BoxId Search::number(const OpenBox& parent, std::uint32_t variable, double at) noexcept {
  const BoxId first = state_.next_id;
  observer_.on_split(parent, {parent.id, variable, at, first});
  state_.next_id += 2;
  return first;
}

void Search::lose(const OpenBox& first, const OpenBox& second) noexcept {
  stop_at_open_box(Reason::kMemory);
  observer_.on_open(first);
  observer_.on_open(second);
}

void Search::settle(Decisions& batch, std::size_t lane) noexcept {
  if (batch.decision[lane].rule == Rule::kBlocked) block(batch, lane);
}

void Search::block(Decisions& batch, std::size_t lane) noexcept {
  leave(batch, lane);
  const Reason reason = batch.decision[lane].reason;
  const std::span<const Interval> box = batch.box_of(lane);
  if (!state_.blocked) state_.boxes_when_blocked = state_.statistics.boxes;
  // Near a pole many boxes are too narrow to split; the undefined one shows the reason.
  if (!state_.blocked ||
      (reason == Reason::kUndefined && state_.blocked_reason == Reason::kWidth)) {
    state_.blocked = true;
    state_.blocked_reason = reason;
    std::copy(box.begin(), box.end(), state_.blocking_box.begin());
  }
  const std::uint64_t blocked = state_.statistics.leaves[static_cast<std::size_t>(Rule::kBlocked)];
  if (!looking_for_witness()) return;
  schedule_.look_in(box, blocked, state_);
  stopped_ = stopped_ || witness_.found();
}

Result Search::conclude() {
  Result result;
  result.method = settings_.method;
  result.stopped_by = stopped_by_;
  count_up();
  if (state_.witness) {
    result.verdict = Verdict::kSingularity;
    result.reason = state_.witness_reason;
    result.witness = state_.witness;
  } else if (witness_.found()) {
    result.verdict = Verdict::kSingularity;
    result.reason = witness_.reason();
    result.witness = witness_.witness();
  } else if (!state_.blocked && !exhausted_ && frontier_.empty()) {
    result.verdict = Verdict::kNoSingularity;
    result.reason = Reason::kAllBoxesCertified;
  } else {
    result.verdict = Verdict::kPossibleProblem;
    result.reason = state_.blocked ? state_.blocked_reason : *stopped_by_;
    result.blocking_box = state_.blocked ? state_.blocking_box : top_when_stopped_;
  }
  result.statistics = state_.statistics;
  result.filter_boxes = state_.filter_boxes;
  complete(result, problem_, settings_);
  return result;
}

}  // namespace

Result run_search(const Problem& problem, const Settings& settings, std::span<const OpenBox> open,
                  const SearchState& state, Observer* observer) {
  return Search(problem, settings, observer).run(open, state);
}

}  // namespace regulus
