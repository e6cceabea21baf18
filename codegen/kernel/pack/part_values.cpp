// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/pack/part_values.hpp"

namespace regulus::detail {

PartValues::ValueId PartValues::add(Pack operation, std::uint32_t a, std::uint32_t b,
                                    std::uint32_t c, NodeId of) {
  spend(meter_, 1);
  code_.code.push_back({operation, a, b, c});
  nodes_.push_back(of);
  return static_cast<ValueId>(code_.code.size() - 1);
}

void PartValues::define(NodeId id, ValueId value) {
  if (plan_.magnitudes.needs_check[id]) value = add(Pack::kChecked_IU, value);
  nodes_[value] = id;
  value_of_[id] = value;
  if (plan_.slots[id] != kNoSlot)
    add(Pack::kKeep, static_cast<std::uint32_t>(plan_.slots[id]), use_as_interval(id));
}

PartValues::ValueId PartValues::use(NodeId id) {
  if (const auto found = value_of_.find(id); found != value_of_.end()) return found->second;
  const ValueId value = plan_.leaves[id] ? leaf(id) : fetch(id);
  nodes_[value] = id;
  value_of_[id] = value;
  return value;
}

PartValues::ValueId PartValues::use_as_interval(NodeId id) {
  if (is_interval(id)) return use(id);
  if (const auto found = interval_of_.find(id); found != interval_of_.end()) return found->second;
  const ValueId value = plan_.known[id] ? add(Pack::kConstant, constant(*plan_.known[id]))
                                        : add(Pack::kThin_P, use(id));
  interval_of_[id] = value;
  return value;
}

PartValues::ValueId PartValues::use_negated(NodeId id) {
  if (node(id).op == Op::kNegate && plan_.leaves[id] && !plan_.known[id]) return use(node(id).a);
  if (const auto found = negated_.find(id); found != negated_.end()) return found->second;
  const ValueId value = plan_.known[id]
                            ? add(Pack::kExact, constant(Interval(-plan_.known[id]->lo)))
                            : add(Pack::kNegate_P, use(id));
  negated_[id] = value;
  return value;
}

PartValues::ValueId PartValues::leaf(NodeId id) {
  const Node& n = node(id);
  if (plan_.known[id]) return known(id);
  if (n.op == Op::kNegate) return add(Pack::kNegate_P, use(n.a));
  return add(n.op == Op::kInput ? Pack::kLoad : Pack::kPoint, n.index);
}

PartValues::ValueId PartValues::known(NodeId id) {
  const Interval& bounds = *plan_.known[id];
  if (!is_interval(id)) return add(Pack::kExact, constant(bounds));
  const ValueId value = add(Pack::kConstant, constant(bounds));
  return plan_.magnitudes.needs_check[id] ? add(Pack::kChecked_IU, value) : value;
}

std::uint32_t PartValues::constant(Interval bounds) {
  if (bounds.lo == 0.0) bounds.lo = 0.0;
  if (bounds.hi == 0.0) bounds.hi = 0.0;
  const auto [place, is_new] = constant_index_.try_emplace(
      {bounds.lo, bounds.hi}, static_cast<std::uint32_t>(code_.constants.size()));
  if (is_new) code_.constants.push_back(bounds);
  return place->second;
}

PartValues::ValueId PartValues::fetch(NodeId id) {
  const ValueId kept = add(Pack::kFetch, static_cast<std::uint32_t>(plan_.slots[id]));
  return is_interval(id) ? kept : add(Pack::kPointOf_I, kept);
}

}  // namespace regulus::detail
