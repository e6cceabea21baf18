// SPDX-License-Identifier: GPL-3.0-or-later
// The operations of a function while they are listed, and the operation that has the value of each
// node.
#pragma once

#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "codegen/kernel/pack/partition.hpp"
#include "codegen/kernel/pack/select.hpp"
#include "codegen/kernel/program/program.hpp"
#include "codegen/support/work_meter.hpp"
#include "runtime/machine/pack_program.hpp"

namespace regulus::detail {

/// Lists operations, and loads or fetches each operand once in each part.
class PartValues {
 public:
  using ValueId = machine::ValueId;
  using Pack = machine::PackOperation;

  PartValues(const Program& program, const FunctionPlan& plan, WorkMeter* meter)
      : program_(program), plan_(plan), meter_(meter) {}

  /// Begins a part: values of earlier parts must be fetched again.
  void begin_part() {
    value_of_.clear();
    interval_of_.clear();
    negated_.clear();
  }

  ValueId add(Pack operation, std::uint32_t a = 0, std::uint32_t b = 0, std::uint32_t c = 0,
              NodeId of = SelectedFunction::kNoNode);
  /// Records the value of the node, checked if it may overflow, and keeps it for later parts.
  void define(NodeId id, ValueId value);
  [[nodiscard]] bool knows(NodeId id) const { return value_of_.contains(id); }

  /// Returns the node's value in this part, in the form of the node.
  ValueId use(NodeId id);
  ValueId use_as_interval(NodeId id);
  /// −p for exact doubles p.
  ValueId use_negated(NodeId id);

  [[nodiscard]] bool is_interval(NodeId id) const { return plan_.forms[id] == Form::kInterval; }
  [[nodiscard]] std::size_t size() const noexcept { return code_.code.size(); }
  void end_part() { code_.part_ends.push_back(static_cast<std::uint32_t>(code_.code.size())); }

  [[nodiscard]] machine::PackFunction& code() noexcept { return code_; }
  [[nodiscard]] std::vector<NodeId>& nodes() noexcept { return nodes_; }

 private:
  [[nodiscard]] const Node& node(NodeId id) const { return program_.nodes[id]; }
  ValueId leaf(NodeId id);
  ValueId known(NodeId id);
  ValueId fetch(NodeId id);
  /// Both zeros are the same bound, so they are one constant.
  std::uint32_t constant(Interval bounds);

  const Program& program_;
  const FunctionPlan& plan_;
  WorkMeter* meter_;
  machine::PackFunction code_;
  std::vector<NodeId> nodes_;
  std::unordered_map<NodeId, ValueId> value_of_, interval_of_, negated_;  ///< of this part
  std::map<std::pair<double, double>, std::uint32_t> constant_index_;
};

}  // namespace regulus::detail
