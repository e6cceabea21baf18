// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/shared_boxes.hpp"

#include <algorithm>
#include <new>
#include <utility>

#include "runtime/interval/lanes.hpp"

namespace regulus::detail {
namespace {

/// Fewer boxes are judged before the messages about them have arrived.
constexpr std::size_t kFewestShared = 256;

constexpr double kSecondsOfPatience = 30.0;
constexpr double kSecondsBetweenTwoShows = 0.25;

std::vector<cluster::Unit> units_of(std::span<const SharedBoxes::Box> boxes, double horizon) {
  std::vector<cluster::Unit> units;
  for (std::size_t at = 0; at < boxes.size(); at += kLanes)
    units.push_back(unit_of(boxes.subspan(at, std::min(kLanes, boxes.size() - at)), horizon));
  return units;
}

}  // namespace

cluster::Unit unit_of(std::span<const std::vector<Interval>> boxes, double horizon) {
  cluster::Unit unit;
  unit.depths.assign(boxes.size(), 0);
  for (const std::vector<Interval>& box : boxes)
    unit.ranges.insert(unit.ranges.end(), box.begin(), box.end());
  unit.horizon = horizon;
  return unit;
}

std::vector<std::vector<Interval>> boxes_of(const cluster::Unit& unit, std::size_t intervals) {
  if (unit.size() > kLanes || unit.ranges.size() != unit.size() * intervals)
    throw cluster::MalformedMessage();
  std::vector<std::vector<Interval>> boxes;
  const auto width = static_cast<std::ptrdiff_t>(intervals);
  for (auto at = unit.ranges.begin(); at != unit.ranges.end(); at += width)
    boxes.emplace_back(at, at + width);
  return boxes;
}

bool SharedBoxes::judge(std::span<const Box> boxes, double horizon, const Take& take) {
  boxes_ += boxes.size();
  const bool is_useful = boxes_ > sharing_.boxes_before && boxes.size() >= kFewestShared;
  if (sharing_.workers == nullptr || is_over_ || !is_useful) return false;
  if (!supervisor_) begin();
  supervisor_->add(units_of(boxes, horizon));
  for (std::size_t at = 0; at < boxes.size();) {
    if (is_interrupted()) return end(), false;
    exchange_messages();
    while (take_first(at, take)) continue;
    show_now_and_then();
  }
  return true;
}

void SharedBoxes::begin() {
  const double spent = std::chrono::duration<double>(Clock::now() - start_).count();
  settings_.time_limit = std::max(0.0, sharing_.time_limit - spent);
  settings_.interrupt = sharing_.interrupt;
  cluster::Workers& workers = *sharing_.workers;
  workers.begin(problem_, settings_, learned_, make_);
  supervisor_.emplace(std::vector<cluster::Unit>{}, workers.count(),
                      cluster::Supervisor::Pace{workers.seconds_of_grant(), kSecondsOfPatience});
}

void SharedBoxes::end() noexcept {
  if (sharing_.workers != nullptr && !std::exchange(is_over_, true)) sharing_.workers->end();
}

void SharedBoxes::exchange_messages() {
  cluster::Workers& workers = *sharing_.workers;
  for (cluster::Supervisor::Outgoing& out : supervisor_->grant_work(workers.now()))
    workers.send(out.worker, std::move(out.grant));
  if (std::optional<cluster::Received> in = workers.receive())
    supervisor_->receive(in->worker, in->message, workers.now());
}

/// Takes the outcome of the first unit; `at`: the number of its first box. Returns false if it is
/// not known yet.
bool SharedBoxes::take_first(std::size_t& at, const Take& take) {
  const auto decided = supervisor_->first();
  if (!decided) return false;
  const cluster::Outcome outcome = cluster::read_outcome(*decided->outcome);
  if (outcome.kind == cluster::OutcomeKind::kMemory) throw std::bad_alloc();
  if (outcome.kind != cluster::OutcomeKind::kDecided || !outcome.groups.empty())
    throw cluster::MalformedMessage();
  const std::size_t count = decided->unit->size();
  take(at, count, outcome.events);
  at += count;
  supervisor_->remove_first();
  return true;
}

void SharedBoxes::show_now_and_then() {
  const double now = sharing_.workers->now();
  if (now - shown_at_ < kSecondsBetweenTwoShows) return;
  shown_at_ = now;
  sharing_.workers->show(
      {boxes_, std::nullopt, supervisor_->waiting(), supervisor_->standing_still()});
}

}  // namespace regulus::detail
