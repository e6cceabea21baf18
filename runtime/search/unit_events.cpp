// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/unit_events.hpp"

namespace regulus::detail {
namespace {

using cluster::ByteReader;
using cluster::ByteWriter;
using cluster::MalformedMessage;

// The code of an open box, of the first rule, and of a split in variable 0.
constexpr std::uint32_t kOpen = 0, kFirstRule = 1, kFirstVariable = kFirstRule + kRules;

bool has_determinant(Rule rule, const Settings& settings) noexcept {
  return settings.enclose_determinants && rule != Rule::kOutside;
}

bool has_reason(Rule rule) noexcept { return rule == Rule::kBlocked || rule == Rule::kWitness; }

void put(ByteWriter& to, const WitnessPoint& point) {
  to.put_list(std::span<const Interval>(point.variables));
  to.put_list(std::span<const PlaceInRange>(point.places));
  to.put_list(std::span<const ExactNumber>(point.numbers));
  to.put(point.determinant);
  to.put_list(std::span<const Interval>(point.pose));
  to.put_list(std::span<const Interval>(point.null_vector));
  to.put_list(std::span<const std::uint32_t>(point.chosen));
}

WitnessPoint take_point(ByteReader& from) {
  WitnessPoint point;
  point.variables = from.take_list<Interval>();
  point.places = from.take_list<PlaceInRange>();
  point.numbers = from.take_list<ExactNumber>();
  point.determinant = from.take<Interval>();
  point.pose = from.take_list<Interval>();
  point.null_vector = from.take_list<Interval>();
  point.chosen = from.take_list<std::uint32_t>();
  return point;
}

void put(ByteWriter& to, const Witness& witness) {
  to.put_count(witness.points.size());
  for (const WitnessPoint& point : witness.points) put(to, point);
  to.put(witness.near.has_value());
  if (witness.near) put(to, *witness.near);
}

Witness take_witness(ByteReader& from) {
  Witness witness;
  for (std::uint64_t left = from.take_count(); left > 0; --left)
    witness.points.push_back(take_point(from));
  if (from.take<bool>()) witness.near = take_point(from);
  return witness;
}

/// Writes what the rule alone does not say.
std::string details_of(const Decision& decision, const Settings& settings) {
  ByteWriter bytes;
  if (decision.rule == Rule::kFilter) bytes.put_count(decision.filter);
  if (has_reason(decision.rule)) bytes.put(decision.reason);
  if (has_determinant(decision.rule, settings)) {
    bytes.put(decision.determinant.has_value());
    if (decision.determinant) bytes.put(*decision.determinant);
  }
  if (decision.rule == Rule::kWitness) put(bytes, decision.witness.value());
  return bytes.take();
}

void take_details(ByteReader& from, const Settings& settings, Decision& decision) {
  if (decision.rule == Rule::kFilter) decision.filter = from.take_count();
  if (decision.rule == Rule::kFilter && decision.filter >= settings.filters.size())
    throw MalformedMessage();
  decision.reason = has_reason(decision.rule) ? from.take<Reason>() : Reason::kAllBoxesCertified;
  if (has_determinant(decision.rule, settings) && from.take<bool>())
    decision.determinant = from.take<Interval>();
  if (decision.rule == Rule::kWitness) decision.witness = take_witness(from);
}

}  // namespace

void UnitTree::begin(std::size_t roots) {
  nodes_.assign(roots, {});
  details_.clear();
}

void UnitTree::set_leaf(BoxId box, const Decision& decision) {
  Node& node = nodes_[box];
  node.code = kFirstRule + static_cast<std::uint32_t>(decision.rule);
  std::string details = details_of(decision, settings_);
  if (details.empty()) return;
  node.next = static_cast<std::uint32_t>(details_.size());
  details_.push_back(std::move(details));
}

BoxId UnitTree::split(BoxId box, std::uint32_t variable) {
  const std::size_t lower = nodes_.size();
  nodes_.resize(lower + 2);
  nodes_[box] = {kFirstVariable + variable, static_cast<std::uint32_t>(lower)};
  return lower;
}

std::string UnitTree::events(std::size_t roots, std::vector<BoxId>& open) const {
  ByteWriter bytes;
  std::vector<BoxId> waiting;
  for (std::size_t root = roots; root-- > 0;) waiting.push_back(root);
  while (!waiting.empty()) {
    const BoxId box = waiting.back();
    const Node& node = nodes_[box];
    waiting.pop_back();
    bytes.put_count(node.code);
    if (node.code == kOpen) {
      open.push_back(box);
    } else if (node.code >= kFirstVariable) {
      waiting.push_back(node.next + 1);
      waiting.push_back(node.next);
    } else if (node.next != kNone) {
      bytes.append(details_[node.next]);
    }
  }
  return bytes.take();
}

UnitEvent take_event(ByteReader& from, const Settings& settings) {
  UnitEvent event;
  const std::uint64_t code = from.take_count();
  if (code == kOpen) return event;
  if (code < kFirstVariable) {
    event.kind = UnitEvent::Kind::kLeaf;
    event.decision.rule = static_cast<Rule>(code - kFirstRule);
    take_details(from, settings, event.decision);
    return event;
  }
  event.kind = UnitEvent::Kind::kSplit;
  event.decision.kind = Decision::Kind::kSplit;
  event.decision.variable = static_cast<std::uint32_t>(code - kFirstVariable);
  return event;
}

}  // namespace regulus::detail
