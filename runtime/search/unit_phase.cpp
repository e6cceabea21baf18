// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/unit_phase.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "runtime/search/thread_workers.hpp"
#include "runtime/search/unit_events.hpp"
#include "runtime/search/unit_groups.hpp"
#include "runtime/search/unit_search.hpp"

namespace regulus::detail {
namespace {

/// The units at the beginning: enough for the workers of one machine. Each unit leaves up to four.
constexpr std::size_t kFirstUnits = 64;

constexpr double kPhasePatience = 30.0;
constexpr double kSecondsBetweenShows = 0.25;

cluster::Learned learned_by(SearchRecord& record) {
  cluster::Learned learned;
  learned.threshold = record.state.threshold;
  record.witness.copy_candidates(learned.candidates);
  return learned;
}

/// Users' code may require that only one thread at a time calls it.
unsigned threads_for(const Settings& settings) noexcept {
  return settings.filters.empty() ? settings.threads : 1;
}

}  // namespace

UnitPhase::UnitPhase(SearchRecord& record, const RowStructure& structure)
    : record_(record),
      structure_(structure),
      learned_(learned_by(record)),
      splittable_(splittable_variables(record.problem, record.settings)),
      threads_(
          record.settings.workers != nullptr
              ? nullptr
              : std::make_unique<ThreadWorkers>(threads_for(record.settings), record.deadline())),
      workers_(threads_ ? *threads_ : *record.settings.workers),
      box_(record.problem.outer),
      start_(record.problem.outer) {}

UnitPhase::~UnitPhase() { workers_.end(); }

/// Makes the first units of a search from its boxes, or takes the units of a checkpoint.
void UnitPhase::cut_frontier() {
  const Frontier& frontier = record_.frontier;
  if (!record_.state.units.empty()) {
    sizes_.assign(record_.state.units.rbegin(), record_.state.units.rend());
    return;
  }
  std::vector<std::uint32_t> depths;
  for (std::size_t i = 0; i < frontier.size(); ++i) depths.push_back(frontier.at(i).depth);
  for (const std::size_t size : cut_into_groups(depths, kFirstUnits))
    sizes_.push_back(static_cast<std::uint32_t>(size));
  std::reverse(sizes_.begin(), sizes_.end());
}

std::vector<cluster::Unit> UnitPhase::units() const {
  std::vector<cluster::Unit> units;
  std::size_t next = 0;
  for (std::size_t i = sizes_.size(); i-- > 0;) {
    cluster::Unit& unit = units.emplace_back();
    for (const std::size_t end = next + sizes_[i]; next < end; ++next) {
      const OpenBox box = record_.frontier.at(next);
      unit.depths.push_back(box.depth);
      unit.ranges.insert(unit.ranges.end(), box.box.begin(),
                         box.box.begin() + static_cast<std::ptrdiff_t>(splittable_));
    }
  }
  return units;
}

void UnitPhase::run() {
  cut_frontier();
  save_units();
  workers_.begin(record_.problem, record_.settings, learned_, nullptr);
  supervisor_.emplace(units(), workers_.count(),
                      cluster::Supervisor::Pace{workers_.seconds_of_grant(), kPhasePatience});
  while (goes_on() && !record_.must_stop()) {
    exchange_messages();
    const std::uint64_t before = record_.state.statistics.boxes;
    take_decided();
    save_units();
    // A pause keeps no outcomes that are not in order yet. So it waits for the next that is: a search
    // that stopped at each pause would otherwise decide the same units again and never end.
    record_.tell_progress(record_.state.statistics.boxes > before);
    show_progress();
  }
  if (record_.state.blocked && !record_.settings.exhaustive) record_.state.units.clear();
}

/// A box that cannot be decided leaves the rest to the rounds, which take the widest boxes first.
bool UnitPhase::goes_on() noexcept {
  const bool blocked = record_.state.blocked && !record_.settings.exhaustive;
  return !record_.stopped() && !record_.frontier.empty() && !blocked;
}

void UnitPhase::exchange_messages() {
  for (cluster::Supervisor::Outgoing& out : supervisor_->grant_work(workers_.now()))
    workers_.send(out.worker, std::move(out.grant));
  if (std::optional<cluster::Received> in = workers_.receive())
    supervisor_->receive(in->worker, in->message, workers_.now());
}

void UnitPhase::take_decided() {
  while (goes_on()) {
    const auto decided = supervisor_->first();
    if (!decided || record_.must_stop() || !take(*decided)) return;
    supervisor_->remove_first();
  }
}

/// Returns false if the search stops before this unit.
bool UnitPhase::take(const cluster::Supervisor::Decided& decided) {
  const cluster::Outcome outcome = cluster::read_outcome(*decided.outcome);
  const bool fits = fits_into_budget(outcome);
  if (outcome.kind == cluster::OutcomeKind::kMemory || !fits) {
    record_.stop_at_open_box(fits ? Reason::kMemory : Reason::kBoxBudget);
    return false;
  }
  require_same_boxes(*decided.unit);
  record_.state.statistics.boxes += outcome.boxes;
  record_.probes_in_boxes += outcome.probes;
  if (outcome.kind == cluster::OutcomeKind::kWitness) prove_again(*decided.unit);
  sizes_.pop_back();
  replay(outcome, decided.unit->size());
  for (std::size_t i = outcome.groups.size(); i-- > 0;)
    sizes_.push_back(static_cast<std::uint32_t>(outcome.groups[i].size()));
  if (goes_on()) look_for_witness(outcome);
  return true;
}

/// A budget ends a search between two units, so that a continued search has the same units.
bool UnitPhase::fits_into_budget(const cluster::Outcome& outcome) noexcept {
  const std::uint64_t boxes = record_.state.statistics.boxes;
  return boxes <= record_.settings.max_boxes && outcome.boxes <= record_.settings.max_boxes - boxes;
}

/// The boxes of a unit come from the outcome of an earlier one. They must be what its splits give.
void UnitPhase::require_same_boxes(const cluster::Unit& unit) const {
  if (unit.size() != sizes_.back()) throw cluster::MalformedMessage();
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const OpenBox box = record_.frontier.at(i);
    const auto ranges = unit.ranges.begin() + static_cast<std::ptrdiff_t>(i * splittable_);
    if (unit.depths[i] != box.depth ||
        !std::equal(ranges, ranges + static_cast<std::ptrdiff_t>(splittable_), box.box.begin()))
      throw cluster::MalformedMessage();
  }
}

/// Tells the record what happened to the boxes of a unit, in preorder.
void UnitPhase::replay(const cluster::Outcome& outcome, std::size_t roots) {
  cluster::ByteReader events(outcome.events);
  const std::size_t rest = record_.frontier.size() - roots;
  Statistics& statistics = record_.state.statistics;
  left_.clear();
  while (record_.frontier.size() > rest) {
    replay_box(events);
    statistics.max_frontier =
        std::max<std::uint64_t>(statistics.max_frontier, record_.frontier.size() + left_.size());
  }
  if (!events.at_end()) throw cluster::MalformedMessage();
  put_back();
}

void UnitPhase::replay_box(cluster::ByteReader& events) {
  UnitEvent event = take_event(events, record_.settings);
  const OpenBox top = record_.frontier.top();
  std::copy(top.box.begin(), top.box.end(), box_.begin());
  const OpenBox box{top.id, top.depth, box_};
  record_.frontier.pop();
  switch (event.kind) {
    case UnitEvent::Kind::kOpen:
      left_.push_back({box.id, box.depth, box_});
      break;
    case UnitEvent::Kind::kLeaf:
      leave(box, event.decision);
      break;
    case UnitEvent::Kind::kSplit:
      split(box, event.decision.variable);
      break;
  }
}

void UnitPhase::leave(const OpenBox& box, Decision& decision) {
  Proof proof;
  proof.reason = decision.reason;
  proof.determinant = decision.determinant;
  if (decision.witness) proof.witness = &*decision.witness;
  if (decision.rule == Rule::kBlocked) return record_.block(box, decision.reason, proof);
  if (decision.rule == Rule::kFilter) ++record_.state.filter_boxes[decision.filter];
  record_.leave(box, decision.rule, proof);
  record_.keep_witness(decision);
}

void UnitPhase::split(const OpenBox& box, std::uint32_t variable) {
  const auto halves = variable < splittable_ ? bisect(box_[variable]) : std::nullopt;
  if (!halves) throw cluster::MalformedMessage();
  const BoxId id = record_.split(box, variable, halves->left.hi);
  box_[variable] = halves->right;
  push({id + 1, box.depth + 1, box_});
  box_[variable] = halves->left;
  push({id, box.depth + 1, box_});
}

void UnitPhase::push(const OpenBox& box) {
  if (!record_.push_top(box)) throw std::bad_alloc();
}

void UnitPhase::put_back() {
  for (std::size_t i = left_.size(); i-- > 0;) push({left_[i].id, left_[i].depth, left_[i].box});
}

/// Looks downhill now and then, each time from what was learned before the first unit.
void UnitPhase::look_for_witness(const cluster::Outcome& outcome) {
  if (outcome.start.empty() || !record_.looking_for_witness()) return;
  if (record_.state.statistics.boxes < record_.state.next_descent) return;
  std::copy(outcome.start.begin(), outcome.start.end(), start_.begin());
  record_.schedule.look_from(start_, record_.state);
  if (record_.witness.found()) return record_.stop();
  record_.witness.forget();
  record_.witness.look_on_from(learned_.candidates);
}

/// The proof does not travel. The same unit gives the same proof here.
void UnitPhase::prove_again(const cluster::Unit& unit) {
  const std::atomic<bool> stop = false;
  Settings settings = record_.settings;
  settings.interrupt = nullptr;
  const std::uint64_t probes = record_.witness.probes();
  UnitSearch search(record_.problem, settings, structure_, learned_, record_.witness, stop);
  static_cast<void>(search.decide(unit));
  if (!record_.witness.found()) throw cluster::MalformedMessage();
  record_.probes_in_boxes -= record_.witness.probes() - probes;
  record_.stop();
}

void UnitPhase::save_units() { record_.state.units.assign(sizes_.rbegin(), sizes_.rend()); }

/// It looks at every open box, so it is done only a few times a second.
void UnitPhase::show_progress() {
  if (workers_.now() - shown_at_ < kSecondsBetweenShows) return;
  shown_at_ = workers_.now();
  double open = 0.0;
  for (std::size_t i = 0; i < record_.frontier.size(); ++i)
    open += std::ldexp(1.0, -static_cast<int>(std::min(record_.frontier.at(i).depth, 1000U)));
  workers_.show({record_.state.statistics.boxes, 1.0 - open, supervisor_->waiting(),
                 supervisor_->standing_still()});
}

}  // namespace regulus::detail
