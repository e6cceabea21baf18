// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/shared_boxes.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace regulus {
namespace {

/// Fewer boxes are decided before the messages about them have arrived.
constexpr std::size_t kFewestShared = 256;

constexpr double kSecondsOfPatience = 30.0;
constexpr double kSecondsBetweenTwoShows = 0.25;

std::vector<cluster::Unit> units_of(std::span<const BoxJudge::Box> boxes, double attained) {
  std::vector<cluster::Unit> units;
  for (std::size_t at = 0; at < boxes.size(); at += kLanes)
    units.push_back(unit_of(boxes.subspan(at, std::min(kLanes, boxes.size() - at)), attained));
  return units;
}

}  // namespace

bool SharedBoxes::judge(std::span<const BoxJudge::Box> boxes, std::span<BoxFinding> findings,
                        double attained) {
  boxes_ += boxes.size();
  const bool is_useful = boxes_ > sharing_.boxes_before && boxes.size() >= kFewestShared;
  if (sharing_.workers == nullptr || is_over_ || !is_useful) return false;
  if (!supervisor_) begin();
  supervisor_->add(units_of(boxes, attained));
  std::span<BoxFinding> left = findings;
  while (!left.empty()) {
    if (is_interrupted()) {
      end();
      std::ranges::fill(findings, BoxFinding{});
      return false;
    }
    exchange_messages();
    while (take_first(left)) continue;
    show_now_and_then();
  }
  return true;
}

void SharedBoxes::begin() {
  const double spent = std::chrono::duration<double>(Clock::now() - start_).count();
  settings_.time_limit = std::max(0.0, sharing_.time_limit - spent);
  settings_.interrupt = sharing_.interrupt;
  cluster::Workers& workers = *sharing_.workers;
  workers.begin(question_.problem, settings_, learned_, condition_deciders(question_));
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

/// Takes the outcome of the first unit; `findings` are those of all units that are left. Returns
/// false if it is not known yet.
bool SharedBoxes::take_first(std::span<BoxFinding>& findings) {
  const auto decided = supervisor_->first();
  if (!decided) return false;
  const std::size_t count = decided->unit->size();
  read_findings(*decided->outcome, question_, findings.first(count));
  findings = findings.subspan(count);
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

}  // namespace regulus
