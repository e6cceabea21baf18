// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "codegen/kernel/program/program.hpp"
#include "codegen/kernel/symbolic/expression.hpp"
#include "codegen/support/work_meter.hpp"

namespace regulus::detail {

/// Translates expressions into one program that shares their common sub-expressions.
class Lowering {
 public:
  /// `points` empty: the expressions must not contain entries of K. `meter`: null, or it outlives
  /// this object and counts the nodes of expressions.
  Lowering(const std::vector<std::string>& variables, const std::vector<std::string>& points,
           WorkMeter* meter = nullptr);

  /// Appends an output.
  NodeId output(const Expression& e);

  /// Appends an output that is undefined wherever one of `conditions` is.
  ///
  /// Ensures   if all conditions are defined, the output encloses e as tightly as output(e) does.
  /// Returns   the node of e.
  NodeId output_where_defined(const Expression& e, const Expressions& conditions);

  /// Appends a node as output, with the entry of K that is `further` places after it in `points`
  /// for each entry of K.
  void output_moved(NodeId node, std::uint32_t further);

  [[nodiscard]] Program finish() && { return std::move(builder_).finish(); }

 private:
  NodeId lower(const Expression& e);
  NodeId lowered(const Expression& e);
  NodeId lower_call(const Expression& e);
  NodeId lower_product(const Expressions& factors);
  NodeId lower_sum(const Expressions& terms);

  ProgramBuilder builder_;
  WorkMeter* meter_;
  std::unordered_map<std::string, std::uint32_t> inputs_, points_;
  std::unordered_map<Expression, NodeId, ExpressionHash> known_;
};

}  // namespace regulus::detail
