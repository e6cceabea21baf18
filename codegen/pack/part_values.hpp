// SPDX-License-Identifier: GPL-3.0-or-later
// The operations of a function as they are listed, and which of them has the value of a node.
#pragma once

#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "codegen/pack/partition.hpp"
#include "codegen/pack/select.hpp"
#include "codegen/program/program.hpp"
#include "codegen/program/work_meter.hpp"
#include "runtime/machine/pack_program.hpp"

namespace regulus::inline packing {

/// Lists operations, and loads or fetches each operand once in each part.
class PartValues {
 public:
  using ValueId = machine::ValueId;
  using Pack = machine::PackOperation;

  PartValues(const Program& program, const FunctionPlan& plan, WorkMeter* meter)
      : program_(program), plan_(plan), meter_(meter) {}

  /// Values of earlier parts are to be fetched again.
  void begin_part() {
    value_of_.clear();
    interval_of_.clear();
    negated_.clear();
  }

  ValueId add(Pack operation, std::uint32_t a = 0, std::uint32_t b = 0, std::uint32_t c = 0,
              NodeId of = SelectedFunction::kNoNode);
  /// The value is the node's, checked where it may overflow, and kept for the parts that follow.
  void define(NodeId id, ValueId value);
  [[nodiscard]] bool knows(NodeId id) const { return value_of_.contains(id); }

  /// The node's value in this part, of the node's own form.
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
  /// The two zeros are one bound, and one constant.
  std::uint32_t constant(Interval bounds);

  const Program& program_;
  const FunctionPlan& plan_;
  WorkMeter* meter_;
  machine::PackFunction code_;
  std::vector<NodeId> nodes_;
  std::unordered_map<NodeId, ValueId> value_of_, interval_of_, negated_;  ///< of this part
  std::map<std::pair<double, double>, std::uint32_t> constant_index_;
};

}  // namespace regulus::inline packing
