// SPDX-License-Identifier: Apache-2.0
// Algorithm 1 on up to eight boxes at a time, with the constraints of Table II.
//
// A box leaves the search for one of three reasons: a constraint excludes it, a test certifies
// it, or it cannot be decided and must not be split any more. The last kind rules out NO
// SINGULARITY; the search then continues for a while, widest boxes first, since SINGULARITY may
// still be shown. An exhaustive search decides all boxes, and searches for a singularity inside
// each that remains.
//
// The first boxes are decided in rounds, each of which learns from those before it. The rest of a
// long search is cut into units, which learn nothing from each other.
#include "runtime/search/search.hpp"

#include <algorithm>
#include <new>

#include "runtime/search/unit_phase.hpp"

namespace regulus::detail {
namespace {

/// A round has one more batch for each so many boxes that were evaluated before. So a search that
/// ends early does little extra work, and a long one keeps its threads busy.
constexpr std::uint64_t kBoxesABatch = 64;
constexpr std::uint64_t kMaxBatches = 64;

/// After so many boxes, the determinant in closed form is worth the time that forming it takes.
constexpr std::uint64_t kBoxesBeforeClosedForm = 256;

}  // namespace

Search::Search(const Problem& problem, const Settings& settings)
    : settings_(settings),
      structure_(find_row_structure(problem, settings)),
      record_(problem, settings),
      round_(problem, settings, structure_),
      foresight_(problem, settings, structure_, round_.order()),
      loop_(*this, record_.frontier, round_.bisector(), problem.kernel->variables) {}

void Search::learn_from(const Search& other) noexcept { foresight_.learn_from(other.foresight_); }

void Search::take_ranges() {
  record_.witness.take_ranges();
  round_.take_ranges();
  foresight_.take_ranges();
}

Result Search::run(std::span<const OpenBox> open, const SearchState& state, Observer* observer) {
  closed_form_made_ = false;
  foresight_.begin(open, state);
  record_.begin(open, state, round_.bisector(), observer);
  round_.begin(record_.deadline());
  loop_.run();
  while (!record_.stopped() && must_be_cut()) {
    run_units();
    loop_.run();
  }
  record_.tell_what_is_open();
  Result result = record_.conclude();
  record_.observer().on_finish(result);
  return result;
}

/// The order of the paper needs one box at a time. The search for a singularity beside a box that
/// could not be decided needs the widest box first.
bool Search::must_be_cut() const noexcept {
  if (settings_.batch == 1 || record_.frontier.empty()) return false;
  if (record_.state.blocked && !settings_.exhaustive) return false;
  return record_.state.statistics.boxes >= settings_.boxes_before_units ||
         !record_.state.units.empty();
}

void Search::run_units() try {
  make_closed_form();
  UnitPhase(record_, structure_).run();
} catch (const std::bad_alloc&) {
  record_.stop_at_open_box(Reason::kMemory);
}

bool Search::begin_round() noexcept {
  return !record_.stopped() && !record_.must_stop(has_budget_for_round()) && !must_be_cut();
}

std::size_t Search::decide_round() noexcept {
  make_closed_form();
  load_round();
  if (!round_.decide(foresight_) && !round_.decide(record_.state.threshold))
    stop_at_undecided_batch();
  for (std::size_t i = 0; i < round_.size(); ++i) foresight_.learn(round_.batch(i));
  return round_.size();
}

/// Memory is exhausted. The results of the other batches count; these boxes are given back.
void Search::stop_at_undecided_batch() noexcept {
  record_.stop_at_open_box(Reason::kMemory);
  for (std::size_t i = round_.size(); i-- > 0;)
    if (!round_.batch(i).decided) record_.name_open_box(round_.batch(i).box_of(0));
}

void Search::make_closed_form() noexcept {
  if (closed_form_made_ || settings_.closed_form == nullptr) return;
  if (settings_.method != Method::kAuto) return;
  if (record_.state.statistics.boxes < kBoxesBeforeClosedForm) return;
  closed_form_made_ = true;
  settings_.closed_form->make();
}

/// The order of the paper needs one box at a time.
std::uint64_t Search::batches_of_round() const noexcept {
  if (settings_.batch == 1) return 1;
  return std::min(1 + record_.state.statistics.boxes / kBoxesABatch, kMaxBatches);
}

/// A budget ends a search between two rounds, never within one. The boxes of a round decide which
/// come next. So a continued search takes the same boxes as a search without a stop.
bool Search::has_budget_for_round() const noexcept {
  if (must_be_cut()) return true;
  const std::uint64_t boxes = record_.state.statistics.boxes, size = record_.frontier.size();
  const std::uint64_t next = std::min(batches_of_round() * settings_.batch, size);
  return boxes <= settings_.max_boxes && next <= settings_.max_boxes - boxes;
}

void Search::load_round() noexcept {
  const std::uint64_t most = batches_of_round();
  round_.clear();
  while (round_.size() < most && !record_.frontier.empty()) {
    Decisions* batch = round_.append();
    if (batch == nullptr) break;
    load(*batch);
  }
  if (round_.size() == 0) record_.stop_at_open_box(Reason::kMemory);
}

void Search::load(Decisions& batch) noexcept {
  // If NO SINGULARITY is not possible any more, the widest boxes show most of the rest.
  const bool from_end = record_.state.blocked && !settings_.exhaustive;
  Frontier& frontier = record_.frontier;
  while (batch.count() < settings_.batch && !frontier.empty()) {
    batch.add(from_end ? frontier.end() : frontier.top());
    foresight_.note_box(batch.open(batch.count() - 1));
    from_end ? frontier.pop_end() : frontier.pop();
    ++record_.state.statistics.boxes;
  }
}

/// Gives back a batch that was not decided because the search must stop.
void Search::give_back(Decisions& batch) noexcept {
  for (std::size_t lane = batch.count(); lane-- > 0; --record_.state.statistics.boxes) {
    const OpenBox& box = batch.open(lane);
    if (record_.push_top(box)) continue;
    record_.stop_at_open_box(Reason::kMemory);
    record_.observer().on_open(box);
  }
}

bool Search::conclude(Decisions& batch) noexcept {
  if (!batch.decided) return true;
  SearchState& state = record_.state;
  for (std::size_t t = 0; t < batch.budget.trials; ++t)
    state.threshold.learn(batch.budget.trial[t]);
  record_.probes_in_boxes += batch.probes;
  for (std::size_t lane = 0; lane < batch.count(); ++lane) {
    const Decision& decision = batch.decision[lane];
    if (decision.kind == Decision::Kind::kLeaf && decision.rule != Rule::kBlocked)
      leave(batch, lane);
  }
  if (settings_.exhaustive) return true;
  record_.witness.look_at_midpoints(batch);
  if (record_.looking_for_witness()) record_.schedule.look_after(batch, state);
  if (record_.witness.found()) record_.stop();
  return !record_.witness.found();
}

void Search::leave(Decisions& batch, std::size_t lane) noexcept {
  Decision& decision = batch.decision[lane];
  if (decision.rule == Rule::kFilter) ++record_.state.filter_boxes[decision.filter];
  record_.leave(batch.open(lane), decision.rule, batch.proof(lane));
  // Moved, which needs no memory: the batch does not need it any more.
  record_.keep_witness(decision);
}

bool Search::splits(const OpenBox& box) noexcept {
  if (record_.exhausted()) record_.observer().on_open(box);
  return !record_.exhausted();
}

BoxId Search::number(const OpenBox& parent, std::uint32_t variable, double at) noexcept {
  const BoxId first = record_.split(parent, variable, at);
  foresight_.note_split(parent, variable, first);
  return first;
}

void Search::lose(const OpenBox& first, const OpenBox& second) noexcept {
  record_.stop_at_open_box(Reason::kMemory);
  record_.observer().on_open(first);
  record_.observer().on_open(second);
}

void Search::settle(Decisions& batch, std::size_t lane) noexcept {
  const Decision& decision = batch.decision[lane];
  if (decision.rule == Rule::kBlocked)
    record_.block(batch.open(lane), decision.reason, batch.proof(lane));
}

}  // namespace regulus::detail
