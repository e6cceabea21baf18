// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/scale/trace.hpp"

#include "tests/bench/measure/clocks.hpp"

namespace regulus::bench {

std::string key_of(const cluster::Unit& unit) {
  cluster::ByteWriter bytes;
  put(bytes, unit);
  return bytes.take();
}

void RecordingWorkers::begin(const Problem& problem, const Settings& settings,
                             const cluster::Learned& learned) {
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
  trace_.seconds += seconds;
  if (outcome) trace_.units[key_of(unit)] = {*outcome, seconds};
  return outcome;
}

}  // namespace regulus::bench
