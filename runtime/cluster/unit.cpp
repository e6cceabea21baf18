// SPDX-License-Identifier: Apache-2.0
#include "runtime/cluster/unit.hpp"

namespace regulus::detail::cluster {
namespace {

std::vector<Unit> take_groups(ByteReader& from) {
  const std::uint64_t count = from.take_count();
  if (count > kMaxGroups) throw MalformedMessage();
  std::vector<Unit> groups;
  for (std::uint64_t i = 0; i < count; ++i) groups.push_back(take_unit(from));
  return groups;
}

}  // namespace

/// No unit is without boxes: a horizon other than 0 comes after a number of 0.
void put(ByteWriter& to, const Unit& unit) {
  if (unit.horizon != 0) {
    to.put_count(0);
    to.put(unit.horizon);
  }
  to.put_list(std::span<const std::uint32_t>(unit.depths));
  to.put_list(std::span<const Interval>(unit.ranges));
}

Unit take_unit(ByteReader& from) {
  Unit unit;
  unit.depths = from.take_list<std::uint32_t>();
  if (unit.depths.empty()) {
    unit.horizon = from.take<double>();
    unit.depths = from.take_list<std::uint32_t>();
  }
  unit.ranges = from.take_list<Interval>();
  if (unit.depths.empty() || unit.ranges.size() % unit.depths.size() != 0) throw MalformedMessage();
  return unit;
}

std::string write_outcome(const Outcome& outcome) {
  ByteWriter bytes;
  bytes.put_count(outcome.groups.size());
  for (const Unit& group : outcome.groups) put(bytes, group);
  bytes.put(outcome.kind);
  bytes.put_count(outcome.boxes);
  bytes.put_count(outcome.probes);
  bytes.put_list(std::span<const Interval>(outcome.start));
  bytes.append(outcome.events);
  return bytes.take();
}

std::vector<Unit> read_groups(std::string_view outcome) {
  ByteReader reader(outcome);
  return take_groups(reader);
}

Outcome read_outcome(std::string_view bytes) {
  ByteReader reader(bytes);
  Outcome outcome;
  outcome.groups = take_groups(reader);
  outcome.kind = reader.take<OutcomeKind>();
  if (outcome.kind > OutcomeKind::kMemory) throw MalformedMessage();
  outcome.boxes = reader.take_count();
  outcome.probes = reader.take_count();
  outcome.start = reader.take_list<Interval>();
  outcome.events = reader.rest();
  return outcome;
}

}  // namespace regulus::detail::cluster
