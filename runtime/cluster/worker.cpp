// SPDX-License-Identifier: Apache-2.0
#include "runtime/cluster/worker.hpp"

#include <utility>

namespace regulus::detail::cluster {

Worker::Progress Worker::begin(Grant grant) {
  Progress progress;
  for (std::size_t i = grant.units.size(); i-- > 0;) progress.left.push_back(i);
  progress.answer.grant = grant.number;
  progress.grant = std::move(grant);
  return progress;
}

/// Decides a unit, then its groups, then the next unit. Returns false if the search ends.
bool Worker::decide_next(UnitDecider& decider) {
  Progress& work = grants_.front();
  if (work.left.empty()) return true;
  const std::size_t number = work.left.back();
  std::optional<std::string> outcome = decider.decide(work.grant.units[number]);
  if (!outcome) {
    grants_.clear();
    return false;
  }
  work.left.pop_back();
  work.boxes += read_outcome(*outcome).boxes;
  std::vector<Unit> groups = read_groups(*outcome);
  const std::size_t first = work.grant.units.size();
  for (std::size_t i = groups.size(); i-- > 0;) work.left.push_back(first + i);
  for (Unit& group : groups) work.grant.units.push_back(std::move(group));
  work.answer.results.push_back({number, std::move(*outcome)});
  return true;
}

std::optional<std::string> Worker::end_step(double seconds) {
  Progress& work = grants_.front();
  work.answer.seconds += seconds;
  if (!work.left.empty() && work.boxes < work.grant.budget) return std::nullopt;
  std::string answer = write_answer(work.answer);
  grants_.pop_front();
  return answer;
}

std::optional<std::string> Worker::tick(double now) {
  if (has_work() || now - reminded_ < kReminder) {
    if (has_work()) reminded_ = now;
    return std::nullopt;
  }
  reminded_ = now;
  return write_answer({});
}

}  // namespace regulus::detail::cluster
