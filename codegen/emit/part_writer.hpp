// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the statements of one part of a function.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "regulus/codegen/emit/expression_text.hpp"
#include "regulus/codegen/emit/function_plan.hpp"
#include "regulus/codegen/emit/value_names.hpp"
#include "regulus/codegen/program/module.hpp"

namespace regulus::codegen {

/// A value used once, in a sum, product or sign, is written inside the expression that uses it, as
/// long as that stays on a line. Products inside sums become mul_add: one rounding instead of two.
class PartWriter {
 public:
  PartWriter(const Module& module, const Function& function, const FunctionPlan& plan,
             ValueNames& names, std::uint32_t part);

  /// What the printed statements read and write, to declare the part's parameters.
  struct Usage {
    bool boxes = false;
    bool points = false;
    bool out = false;
    bool shared = false;
  };

  void write();

  [[nodiscard]] const std::string& declarations() const noexcept { return declarations_; }
  [[nodiscard]] const std::string& statements() const noexcept { return statements_; }
  [[nodiscard]] const Usage& usage() const noexcept { return usage_; }

 private:
  [[nodiscard]] const Node& node(NodeId id) const { return function_.program.nodes[id]; }
  [[nodiscard]] bool is_deferred(NodeId id) const { return deferred_.count(id) != 0; }
  [[nodiscard]] bool is_interval(NodeId id) const { return plan_.forms[id] == Form::kInterval; }

  void find_partners(const Part& part);
  void write_compute(NodeId id);
  void write_store(const Step& step);
  void write_group_comment(const Step& step);
  void write_checked_power(NodeId id);
  bool write_sine_and_cosine(NodeId id);
  void define(NodeId id, const std::string& expression);
  void define_deferred(NodeId id);
  void keep_for_later_parts(NodeId id);
  [[nodiscard]] bool can_be_deferred(NodeId id) const;
  [[nodiscard]] std::vector<NodeId> deferred_operands(NodeId id) const;
  [[nodiscard]] std::optional<NodeId> fused_product(NodeId sum) const;

  /// The expression that computes the node, short enough for a line.
  [[nodiscard]] ExpressionText compute(NodeId id);
  [[nodiscard]] ExpressionText render(NodeId id);
  using BinaryText = ExpressionText (*)(const ExpressionText&, const ExpressionText&);
  [[nodiscard]] ExpressionText combine(BinaryText operation, NodeId a, NodeId b);
  [[nodiscard]] std::pair<NodeId, NodeId> factors(NodeId product) const;
  [[nodiscard]] ExpressionText render_exact(NodeId id);
  [[nodiscard]] ExpressionText render_negation(NodeId a);
  [[nodiscard]] ExpressionText render_product(NodeId id);
  [[nodiscard]] ExpressionText render_sum(NodeId id);
  [[nodiscard]] ExpressionText render_mul_add(NodeId sum, NodeId product);
  [[nodiscard]] std::string negated_point(NodeId id);
  [[nodiscard]] ExpressionText render_power(NodeId id);
  [[nodiscard]] ExpressionText render_call(NodeId id);

  /// The node as an operand: its name, or its expression where it was deferred.
  [[nodiscard]] ExpressionText use(NodeId id);
  [[nodiscard]] ExpressionText use_leaf(NodeId id);
  [[nodiscard]] ExpressionText use_constant(NodeId id);
  [[nodiscard]] std::string as_interval(NodeId id);
  void declare(NodeId id, const std::string& type, const std::string& expression,
               const std::string& comment);

  const Module& module_;
  const Function& function_;
  const FunctionPlan& plan_;
  ValueNames& names_;
  std::uint32_t part_;
  std::unordered_map<NodeId, ExpressionText> deferred_;  ///< what will be written where it is used
  std::vector<bool> named_;                              ///< has a name in this part
  std::map<NodeId, NodeId> partner_;  ///< the cosine of a sine's argument and the reverse
  std::string declarations_;
  std::string statements_;
  Usage usage_;
};

}  // namespace regulus::codegen
