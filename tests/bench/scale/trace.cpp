// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/scale/trace.hpp"

#include "tests/bench/measure/clocks.hpp"

namespace regulus::detail::bench {
namespace {

std::string key_of(const cluster::Unit& unit) {
  cluster::ByteWriter bytes;
  put(bytes, unit);
  return bytes.take();
}

}  // namespace

void RecordingWorkers::begin(const Problem& problem, const Settings& settings,
                             const cluster::Learned& learned, const cluster::MakeDecider&) {
  settings_ = &settings;
  structure_.emplace(find_row_structure(problem, settings));
  witness_ = std::make_unique<WitnessSearch>(problem, settings, false);
  search_ = std::make_unique<UnitSearch>(problem, settings, *structure_, learned, *witness_, stop_);
}

double RecordingWorkers::now() const { return thread_seconds(); }

std::optional<cluster::Received> RecordingWorkers::receive() {
  if (!worker_.has_work()) return std::nullopt;
  std::optional<std::string> answer = worker_.step(*this, [this] { return now(); });
  if (!answer) return std::nullopt;
  return cluster::Received{0, std::move(*answer)};
}

std::optional<std::string> RecordingWorkers::decide(const cluster::Unit& unit) {
  const double before = thread_seconds();
  std::optional<std::string> outcome = search_->decide(unit);
  const double seconds = thread_seconds() - before;
  if (outcome) record(cluster::read_outcome(*outcome), numbers_of(unit), seconds);
  return outcome;
}

/// A unit that no outcome has left is one of the first.
RecordingWorkers::Numbers RecordingWorkers::numbers_of(const cluster::Unit& unit) {
  if (auto known = waiting_.extract(key_of(unit))) return std::move(known.mapped());
  Numbers numbers;
  for (const std::uint32_t depth : unit.depths) {
    numbers.push_back(static_cast<std::uint32_t>(trace_.boxes.size()));
    trace_.boxes.emplace_back();
    trace_.roots.push_back(numbers.back());
    trace_.depths.push_back(depth);
  }
  return numbers;
}

void RecordingWorkers::record(const cluster::Outcome& outcome, const Numbers& boxes,
                              double seconds) {
  trace_.seconds += seconds;
  cluster::ByteReader events(outcome.events);
  const auto share = static_cast<float>(seconds / static_cast<double>(outcome.boxes));
  Numbers open;
  for (const std::uint32_t box : boxes) add_box(box, events, share, open);
  std::size_t next = 0;
  for (const cluster::Unit& group : outcome.groups) {
    const auto first = open.begin() + static_cast<std::ptrdiff_t>(next);
    next += group.size();
    waiting_[key_of(group)] = {first, first + static_cast<std::ptrdiff_t>(group.size())};
  }
}

void RecordingWorkers::add_box(std::uint32_t box, cluster::ByteReader& events, float seconds,
                               Numbers& open) {
  const UnitEvent event = take_event(events, *settings_);
  if (event.kind == UnitEvent::Kind::kOpen) return open.push_back(box);
  trace_.boxes[box].seconds = seconds;
  if (event.kind == UnitEvent::Kind::kLeaf) return;
  const auto lower = static_cast<std::uint32_t>(trace_.boxes.size());
  trace_.boxes[box].lower = lower;
  trace_.boxes.resize(trace_.boxes.size() + 2);
  add_box(lower, events, seconds, open);
  add_box(lower + 1, events, seconds, open);
}

}  // namespace regulus::detail::bench
