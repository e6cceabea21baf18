// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/scale/replay.hpp"

#include <malloc.h>

#include <algorithm>
#include <utility>

#include "runtime/search/unit_groups.hpp"
#include "tests/bench/measure/clocks.hpp"

namespace regulus::detail::bench {
namespace {

/// The messages are as long as those about a robot with six variables.
constexpr std::size_t kVariables = 6;
constexpr std::size_t kFirstUnits = 64;
constexpr std::uint64_t kEventsBetweenMeasurements = 4096;

struct Open {
  std::uint32_t box;
  std::uint32_t depth;
};

void put_box(cluster::Unit& unit, const Open& open) {
  unit.depths.push_back(open.depth);
  unit.ranges.insert(unit.ranges.end(), kVariables, Interval(open.box));
}

std::vector<cluster::Unit> cut(const std::vector<Open>& open, std::size_t most) {
  std::vector<std::uint32_t> depths;
  for (const Open& box : open) depths.push_back(box.depth);
  std::vector<cluster::Unit> groups;
  auto next = open.begin();
  for (const std::size_t size : cut_into_groups(depths, most)) {
    cluster::Unit& group = groups.emplace_back();
    for (std::size_t i = 0; i < size; ++i) put_box(group, *next++);
  }
  return groups;
}

std::vector<cluster::Unit> first_units(const Trace& trace) {
  std::vector<Open> open;
  for (std::size_t i = 0; i < trace.roots.size(); ++i)
    open.push_back({trace.roots[i], trace.depths[i]});
  return cut(open, kFirstUnits);
}

/// Decides boxes as a unit of a search does: the first one first, then its halves.
class TraceDecider final : public cluster::UnitDecider {
 public:
  TraceDecider(const Trace& trace, std::uint64_t boxes) : trace_(trace), most_(boxes) {}

  std::optional<std::string> decide(const cluster::Unit& unit) override {
    std::vector<Open> open;
    for (std::size_t i = unit.size(); i-- > 0;)
      open.push_back({static_cast<std::uint32_t>(unit.ranges[i * kVariables].lo), unit.depths[i]});
    cluster::Outcome outcome;
    for (; outcome.boxes < most_ && !open.empty(); ++outcome.boxes) {
      const Open box = open.back();
      open.pop_back();
      const TracedBox& known = trace_.boxes[box.box];
      seconds += known.seconds;
      if (known.lower == 0) continue;
      open.push_back({known.lower + 1, box.depth + 1});
      open.push_back({known.lower, box.depth + 1});
    }
    std::reverse(open.begin(), open.end());
    if (!open.empty()) outcome.groups = cut(open, cluster::kMaxGroups);
    outcome.events.assign(outcome.boxes + open.size(), '\0');
    return write_outcome(outcome);
  }
  double seconds = 0;

 private:
  const Trace& trace_;
  const std::uint64_t most_;
};

double megabytes_in_use() {
  const struct mallinfo2 info = ::mallinfo2();
  return 1e-6 * static_cast<double>(info.uordblks + info.hblkhd);
}

}  // namespace

Replay::Replay(const Trace& trace, const Job& job)
    : trace_(trace),
      job_(job),
      slower_(static_cast<double>(job.ranks) * job.seconds / trace.seconds),
      supervisor_(first_units(trace), job.ranks,
                  {cluster::Supervisor::Pace::seconds_for(job.ranks), 1e9}),
      ranks_(job.ranks),
      memory_before_(megabytes_in_use()) {}

Replayed Replay::run() {
  while (!supervisor_.empty()) {
    const double before = thread_seconds();
    send_grants();
    take_in_order();
    result_.own_seconds += thread_seconds() - before;
    if (!supervisor_.empty()) take_event();
    if (result_.messages % kEventsBetweenMeasurements == 0) measure_memory();
  }
  result_.seconds = now_;
  return result_;
}

void Replay::send_grants() {
  for (cluster::Supervisor::Outgoing& out : supervisor_.grant_work(now_)) {
    now_ += job_.message;
    events_.push({now_ + job_.latency, result_.messages++, out.worker, true, std::move(out.grant)});
  }
}

void Replay::take_in_order() {
  while (const auto decided = supervisor_.first()) {
    now_ += job_.in_order * static_cast<double>(cluster::read_outcome(*decided->outcome).boxes);
    supervisor_.remove_first();
    ++result_.units;
  }
}

/// Grants that arrive before the next answer are decided first.
void Replay::take_event() {
  for (;;) {
    Event event = std::move(const_cast<Event&>(events_.top()));
    events_.pop();
    if (event.is_grant) {
      decide(event);
      continue;
    }
    now_ = std::max(now_, event.at) + job_.message;
    const double before = thread_seconds();
    supervisor_.receive(event.rank, event.message, now_);
    result_.own_seconds += thread_seconds() - before;
    return;
  }
}

/// A rank decides its grants one after the other.
void Replay::decide(const Event& event) {
  Rank& rank = ranks_[event.rank];
  TraceDecider decider(trace_, job_.unit);
  std::optional<std::string> answer;
  rank.worker.receive(event.message);
  while (!answer) answer = rank.worker.step(decider, [&] { return decider.seconds * slower_; });
  const double seconds = decider.seconds * slower_;
  result_.busy += seconds;
  rank.free_at = std::max(rank.free_at, event.at) + seconds;
  events_.push(
      {rank.free_at + job_.latency, result_.messages++, event.rank, false, std::move(*answer)});
}

void Replay::measure_memory() {
  result_.most_known = std::max(result_.most_known, supervisor_.known());
  result_.most_megabytes = std::max(result_.most_megabytes, megabytes_in_use() - memory_before_);
}

}  // namespace regulus::detail::bench
