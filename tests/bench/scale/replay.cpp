// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/scale/replay.hpp"

#include <algorithm>

namespace regulus::bench {
namespace {

/// Takes outcomes from a trace and adds up their times.
class Replayed final : public cluster::UnitDecider {
 public:
  explicit Replayed(const Trace& trace) : trace_(trace) {}
  std::optional<std::string> decide(const cluster::Unit& unit) override {
    const TracedUnit& known = trace_.units.at(key_of(unit));
    seconds += known.seconds;
    return known.outcome;
  }
  double seconds = 0;

 private:
  const Trace& trace_;
};

}  // namespace

void ReplayedRanks::send(std::size_t worker, std::string grant) {
  supervisor_ += costs_.message;
  events_.push({supervisor_ + costs_.latency, messages_++, worker, true, std::move(grant)});
}

/// A rank decides its grants one after the other.
void ReplayedRanks::decide(std::size_t number, double at, const std::string& grant) {
  Rank& rank = ranks_[number];
  Replayed decider(trace_);
  std::optional<std::string> answer;
  rank.worker.receive(grant);
  while (!answer) answer = rank.worker.step(decider, [&] { return decider.seconds * slower_; });
  const double seconds = decider.seconds * slower_;
  busy_ += seconds;
  rank.free_at = std::max(rank.free_at, at) + seconds;
  events_.push({rank.free_at + costs_.latency, messages_++, number, false, std::move(*answer)});
}

std::optional<cluster::Received> ReplayedRanks::receive() {
  while (!events_.empty()) {
    Event event = events_.top();
    events_.pop();
    if (event.is_grant) {
      decide(event.rank, event.at, event.message);
      continue;
    }
    supervisor_ = std::max(supervisor_, event.at) + costs_.message;
    return cluster::Received{event.rank, std::move(event.message)};
  }
  return std::nullopt;
}

}  // namespace regulus::bench
