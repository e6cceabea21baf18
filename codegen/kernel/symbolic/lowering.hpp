// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
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

  /// Appends an output, with the entry of K that is `further` places after it in `points` for each
  /// entry of K in e.
  void output(const Expression& e, std::uint32_t further = 0);

  /// Appends an output that is undefined wherever one of `conditions` is.
  ///
  /// Ensures   if all conditions are defined, the output encloses e as tightly as output(e) does.
  void output_where_defined(const Expression& e, const Expressions& conditions);

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
  using Known = std::unordered_map<Expression, NodeId, ExpressionHash>;
  Known without_points_;
  std::map<std::uint32_t, Known> with_points_;  // by `further`
  std::uint32_t further_ = 0;
};

}  // namespace regulus::detail
