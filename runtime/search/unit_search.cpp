// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/unit_search.hpp"

#include <algorithm>
#include <new>

#include "runtime/kernel/rounding_scope.hpp"
#include "runtime/search/unit_groups.hpp"

namespace regulus::detail {

std::size_t splittable_variables(const Problem& problem, const Settings& settings) noexcept {
  return settings.uncertainty == Uncertainty::kVariables ? problem.kernel->variables
                                                         : problem.kernel->motion_variables;
}

UnitSearch::UnitSearch(const Problem& problem, const Settings& settings,
                       const RowStructure& structure, const cluster::Learned& learned,
                       WitnessSearch& witness, const std::atomic<bool>& stop,
                       Clock::time_point deadline)
    : problem_(problem),
      settings_(settings),
      learned_(learned),
      stop_(stop),
      deadline_(deadline),
      splittable_(splittable_variables(problem, settings)),
      witness_(witness),
      decider_(problem, settings, structure),
      batch_(*problem.kernel, decider_.order()),
      frontier_(problem.kernel->variables),
      loop_(*this, frontier_, decider_.bisector(), problem.kernel->variables),
      tree_(settings),
      box_(problem.outer) {}

std::optional<std::string> UnitSearch::decide(const cluster::Unit& unit) {
  const RoundingScope scope(REGULUS_ROUND_NEAREST);
  load(unit);
  loop_.run();
  if (stopped_) return std::nullopt;
  return write_outcome(outcome());
}

/// The first box is on top.
void UnitSearch::load(const cluster::Unit& unit) {
  if (unit.ranges.size() != unit.size() * splittable_) throw cluster::MalformedMessage();
  witness_.forget();
  witness_.look_on_from(learned_.candidates);
  threshold_ = learned_.threshold;
  roots_ = unit.size();
  boxes_ = probes_in_boxes_ = 0;
  blocked_ = stopped_ = memory_exhausted_ = false;
  start_.clear();
  tree_.begin(roots_);
  frontier_.clear();
  probes_before_ = witness_.probes();
  for (std::size_t i = roots_; i-- > 0;) {
    std::copy_n(unit.ranges.begin() + static_cast<std::ptrdiff_t>(i * splittable_), splittable_,
                box_.begin());
    const double width = decider_.bisector().approx_relative_width(box_);
    if (!frontier_.push_top({i, unit.depths[i], box_}, width)) throw std::bad_alloc();
  }
}

bool UnitSearch::must_stop() const noexcept {
  const auto is_set = [](const std::atomic<bool>& flag) {
    return flag.load(std::memory_order_relaxed);
  };
  return is_set(stop_) || (settings_.interrupt != nullptr && is_set(*settings_.interrupt)) ||
         (deadline_ != Clock::time_point::max() && Clock::now() >= deadline_);
}

bool UnitSearch::begin_round() noexcept {
  if (boxes_ >= settings_.boxes_of_unit || blocked_ || memory_exhausted_ || witness_.found())
    return false;
  stopped_ = must_stop();
  return !stopped_;
}

std::size_t UnitSearch::decide_round() noexcept try {
  batch_.clear();
  batch_.budget.threshold = threshold_;
  while (batch_.count() < settings_.batch && !frontier_.empty()) {
    batch_.add(frontier_.top());
    frontier_.pop();
    ++boxes_;
  }
  decider_.decide(batch_, false);
  return 1;
} catch (const std::bad_alloc&) {
  memory_exhausted_ = true;
  return 1;
}

/// The outcome will say that nothing is known.
void UnitSearch::give_back(Decisions&) noexcept {}

bool UnitSearch::conclude(Decisions& batch) noexcept {
  if (!batch.decided) return true;
  for (std::size_t t = 0; t < batch.budget.trials; ++t) threshold_.learn(batch.budget.trial[t]);
  probes_in_boxes_ += batch.probes;
  for (std::size_t lane = 0; lane < batch.count(); ++lane)
    if (batch.decision[lane].kind == Decision::Kind::kLeaf) record(batch, lane);
  if (settings_.exhaustive) return true;
  witness_.look_at_midpoints(batch);
  if (start_.empty()) note_start(batch);
  return !witness_.found();
}

void UnitSearch::record(Decisions& batch, std::size_t lane) noexcept try {
  tree_.set_leaf(batch.open(lane).id, batch.decision[lane]);
} catch (const std::bad_alloc&) {
  memory_exhausted_ = true;
}

/// As WitnessSchedule::look_after chooses it.
void UnitSearch::note_start(Decisions& batch) noexcept try {
  const LaneMask undecided =
      batch.uncertified & (problem_.kernel->constraints > 0 ? batch.inside : kAllLanes);
  if (undecided == 0) return;
  std::size_t lane = 0;
  while (!has_lane(undecided, lane)) ++lane;
  const std::span<const Interval> box = batch.box_of(lane).first(splittable_);
  start_.assign(box.begin(), box.end());
} catch (const std::bad_alloc&) {
  memory_exhausted_ = true;
}

void UnitSearch::settle(Decisions& batch, std::size_t lane) noexcept {
  if (batch.decision[lane].rule == Rule::kBlocked && !settings_.exhaustive) blocked_ = true;
}

BoxId UnitSearch::number(const OpenBox& parent, std::uint32_t variable, double) noexcept try {
  return tree_.split(parent.id, variable);
} catch (const std::bad_alloc&) {
  memory_exhausted_ = true;
  return parent.id;
}

cluster::Outcome UnitSearch::outcome() const {
  cluster::Outcome outcome;
  if (memory_exhausted_) {
    outcome.kind = cluster::OutcomeKind::kMemory;
    return outcome;
  }
  outcome.boxes = boxes_;
  outcome.probes = probes_in_boxes_ + witness_.probes() - probes_before_;
  std::vector<BoxId> open;
  outcome.events = tree_.events(roots_, open);
  if (witness_.found()) {
    outcome.kind = cluster::OutcomeKind::kWitness;
    return outcome;
  }
  outcome.start = start_;
  add_groups(open, outcome);
  return outcome;
}

/// The boxes in the frontier are those that are open in the tree.
void UnitSearch::add_groups(const std::vector<BoxId>& open, cluster::Outcome& outcome) const {
  std::vector<std::size_t> place(tree_.size());
  for (std::size_t i = 0; i < frontier_.size(); ++i) place[frontier_.at(i).id] = i;
  std::vector<std::uint32_t> depths;
  for (const BoxId id : open) depths.push_back(frontier_.at(place[id]).depth);
  std::size_t next = 0;
  for (const std::size_t size : cut_into_groups(depths, cluster::kMaxGroups)) {
    cluster::Unit& group = outcome.groups.emplace_back();
    for (const std::size_t end = next + size; next < end; ++next) {
      const OpenBox box = frontier_.at(place[open[next]]);
      group.depths.push_back(box.depth);
      group.ranges.insert(group.ranges.end(), box.box.begin(),
                          box.box.begin() + static_cast<std::ptrdiff_t>(splittable_));
    }
  }
}

}  // namespace regulus::detail
