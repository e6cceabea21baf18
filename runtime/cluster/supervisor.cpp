// SPDX-License-Identifier: Apache-2.0
#include "runtime/cluster/supervisor.hpp"

#include <algorithm>
#include <utility>

namespace regulus::detail::cluster {
namespace {

/// Grants that a worker has at once: while it decides one, the next one is on its way.
constexpr std::size_t kGrantsAhead = 2;

/// Large grants are cheap, small ones soon give work to the others. Parts of Pace::seconds, by the
/// units that wait for each worker.
constexpr double kScarce = 1.0, kVeryScarce = 0.25;
constexpr double kPartIfScarce = 0.1, kPartIfVeryScarce = 0.02;

/// If more units wait for each worker, the first one in order is granted, otherwise the widest; but
/// in one of so many grants always the first one.
constexpr double kMany = 2.0;
constexpr std::uint64_t kGrantsToTheFirst = 4;

/// Several units are granted together only if so many wait for each worker.
constexpr double kPlenty = 8.0;
constexpr std::uint64_t kMaxUnitsOfGrant = 8;

/// An answer may take so many times as long as the longest one so far.
constexpr double kPatienceFactor = 8.0;

/// The place of a unit begins with four bytes.
constexpr std::size_t kMaxUnitsOfSearch = 0xffffffff;

std::string first_place(std::size_t number) {
  std::string place;
  for (int shift = 24; shift >= 0; shift -= 8)
    place += static_cast<char>(static_cast<unsigned char>(number >> shift));
  return place;
}

}  // namespace

double Supervisor::Pace::seconds_for(std::size_t workers) noexcept {
  constexpr double kLeast = 0.1, kMost = 1.0;
  // Two messages of 20 µs for each grant then take a fifth of the supervisor's time.
  constexpr double kSecondsAWorker = 200e-6;
  return std::clamp(kSecondsAWorker * static_cast<double>(workers), kLeast, kMost);
}

Supervisor::Supervisor(std::vector<Unit> units, std::size_t workers, const Pace& pace)
    : pace_(pace), workers_(workers) {
  add(std::move(units));
  for (std::size_t i = 0; i < workers; ++i) idle_.insert(i);
}

void Supervisor::add(std::vector<Unit> units) {
  for (Unit& unit : units) {
    if (next_unit_ > kMaxUnitsOfSearch) throw std::length_error("a search has too many units");
    const Place place = first_place(next_unit_++);
    waiting_.insert(place, unit);
    units_[place].unit = std::move(unit);
  }
}

std::optional<Supervisor::Decided> Supervisor::first() const {
  if (units_.empty() || !units_.begin()->second.outcome) return std::nullopt;
  const Entry& entry = units_.begin()->second;
  return Decided{&entry.unit, &*entry.outcome};
}

void Supervisor::remove_first() { units_.erase(units_.begin()); }

std::vector<std::size_t> Supervisor::standing_still() const {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < workers_.size(); ++i)
    if (workers_[i].still) result.push_back(i);
  return result;
}

/// Puts a worker into the set that shows how much it has to do.
void Supervisor::file(std::size_t worker) {
  idle_.erase(worker);
  nearly_idle_.erase(worker);
  if (workers_[worker].still) return;
  const std::size_t grants = workers_[worker].grants.size();
  if (grants == 0) idle_.insert(worker);
  if (grants > 0 && grants < kGrantsAhead) nearly_idle_.insert(worker);
}

void Supervisor::add_groups(const Place& parent, std::vector<Unit> groups) {
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const Place place = parent + static_cast<char>(i);
    waiting_.insert(place, groups[i]);
    units_[place].unit = std::move(groups[i]);
  }
}

/// An outcome counts once. A unit that is not here any more was in order before.
void Supervisor::accept(std::size_t worker, const Place& place, std::string outcome) {
  const auto found = units_.find(place);
  if (found == units_.end()) return;
  Entry& entry = found->second;
  if (entry.outcome) {
    if (*entry.outcome != outcome) throw Disagreement(entry.decided_by, worker);
    return;
  }
  waiting_.erase(place);
  entry.decided_by = worker;
  entry.outcome = std::move(outcome);
  add_groups(place, read_groups(*entry.outcome));
}

void Supervisor::take_results(std::size_t worker, std::vector<Place> places,
                              std::vector<UnitResult> results) {
  for (UnitResult& result : results) {
    if (result.unit >= places.size()) throw MalformedMessage();
    const Place place = places[result.unit];
    const std::size_t groups = read_groups(result.outcome).size();
    for (std::size_t i = 0; i < groups; ++i) places.push_back(place + static_cast<char>(i));
    accept(worker, place, std::move(result.outcome));
  }
}

/// Lets the units of a grant that were not decided wait again, unless a later grant has them.
void Supervisor::give_back(const std::vector<Place>& places, std::uint64_t grant) {
  for (const Place& place : places) {
    const auto found = units_.find(place);
    if (found != units_.end() && !found->second.outcome && found->second.grant == grant)
      waiting_.insert(place, found->second.unit);
  }
}

void Supervisor::receive(std::size_t worker, std::string_view text, double now) {
  Answer answer = read_answer(text);
  WorkerState& state = workers_.at(worker);
  state.still = false;
  const auto found = sent_.find(answer.grant);
  if (found != sent_.end() && found->second.worker == worker) {
    longest_ = std::max(longest_, now - found->second.at);
    const Sent sent = std::move(found->second);
    sent_.erase(found);
    state.grants.erase(answer.grant);
    std::uint64_t boxes = 0;
    for (const UnitResult& result : answer.results) boxes += read_outcome(result.outcome).boxes;
    if (boxes > 0 && answer.seconds > 0)
      state.seconds_a_box = answer.seconds / static_cast<double>(boxes);
    take_results(worker, sent.places, std::move(answer.results));
    give_back(sent.places, answer.grant);
  }
  file(worker);
}

/// A grant that is overdue stays known: if its answer comes at last, it counts.
void Supervisor::withdraw_overdue(double now) {
  for (auto& [number, sent] : sent_) {
    if (now - sent.at <= std::max(pace_.patience, kPatienceFactor * longest_)) break;
    if (sent.overdue) continue;
    sent.overdue = true;
    workers_[sent.worker].still = true;
    workers_[sent.worker].grants.erase(number);
    file(sent.worker);
    give_back(sent.places, number);
  }
}

double Supervisor::units_a_worker() const noexcept {
  return static_cast<double>(waiting_.size()) / static_cast<double>(workers_.size());
}

std::uint64_t Supervisor::budget_for(const WorkerState& worker) const noexcept {
  if (worker.seconds_a_box == 0) return 1;
  const double waiting = units_a_worker();
  const double part = waiting < kVeryScarce ? kPartIfVeryScarce
                      : waiting < kScarce   ? kPartIfScarce
                                            : 1.0;
  const double boxes = part * pace_.seconds / worker.seconds_a_box;
  return static_cast<std::uint64_t>(std::clamp(boxes, 1.0, 0x1p40));
}

/// If many units wait, the first in order goes first: its outcome leaves the memory soon. If few
/// wait, the widest goes first, since most work is likely to follow from it. Now and then the first
/// one goes first then, too, so that it does not keep all others in the memory.
Place Supervisor::take_waiting() {
  const bool in_order = units_a_worker() > kMany || next_grant_ % kGrantsToTheFirst == 0;
  return in_order ? waiting_.take_first() : waiting_.take_widest();
}

Grant Supervisor::make_grant(std::size_t worker, double now) {
  Grant grant;
  grant.number = next_grant_++;
  grant.budget = budget_for(workers_[worker]);
  Sent& sent = sent_[grant.number];
  sent.worker = worker;
  sent.at = now;
  const std::uint64_t most = units_a_worker() < kPlenty ? 1 : kMaxUnitsOfGrant;
  while (grant.units.size() < most && !waiting_.empty()) {
    Place place = take_waiting();
    Entry& entry = units_.at(place);
    entry.grant = grant.number;
    grant.units.push_back(entry.unit);
    sent.places.push_back(std::move(place));
  }
  workers_[worker].grants.insert(grant.number);
  file(worker);
  return grant;
}

std::vector<Supervisor::Outgoing> Supervisor::grant_work(double now) {
  withdraw_overdue(now);
  std::vector<Outgoing> grants;
  while (!waiting_.empty() && !(idle_.empty() && nearly_idle_.empty())) {
    const std::size_t worker = idle_.empty() ? *nearly_idle_.begin() : *idle_.begin();
    grants.push_back({worker, write_grant(make_grant(worker, now))});
  }
  return grants;
}

}  // namespace regulus::detail::cluster
