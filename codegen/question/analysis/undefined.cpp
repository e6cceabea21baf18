// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/analysis/undefined.hpp"

#include <algorithm>
#include <unordered_set>

#include "codegen/kernel/formulation/substitution.hpp"
#include "codegen/kernel/program/enclose.hpp"
#include "codegen/kernel/program/interval_arithmetic.hpp"
#include "codegen/kernel/symbolic/print.hpp"

namespace regulus::detail {
namespace {

/// As in kernels: beyond this a root or a quotient counts as undefined.
constexpr double kLargestValue = 0x1p128;

/// Returns the outputs over a box; nullopt unless they are certainly defined everywhere on it.
std::optional<std::vector<Interval>> enclose_over(const Program& program,
                                                  std::span<const Interval> box) {
  IntervalArithmetic arithmetic(kLargestValue);
  std::vector<Interval> values(program.nodes.size());
  run<IntervalArithmetic, Interval>(program, enclose_constant_nodes(program), box, {}, values,
                                    arithmetic);
  if (arithmetic.undefined()) return std::nullopt;
  std::vector<Interval> outputs;
  for (const NodeId output : program.outputs) outputs.push_back(values[output]);
  return outputs;
}

std::vector<Interval> middle_of(std::span<const Interval> box) {
  std::vector<Interval> middle;
  for (const Interval& x : box) middle.emplace_back(mid(x));
  return middle;
}

}  // namespace

Definedness::Definedness(const Formulation& formulation)
    : pose_(lower_outputs(formulation, formulation.pose)) {
  std::unordered_set<Expression, ExpressionHash> seen;
  for (const Expression& condition : formulation.must_be_defined)
    for (const Expression& e : partial_nodes(condition)) {
      if (!seen.insert(e).second) continue;
      const Expressions& arguments = e.operands();
      operations_.push_back({to_string(e), arguments.size() == 1 ? to_string(arguments[0]) : "",
                             lower_outputs(formulation, {e}),
                             lower_outputs(formulation, arguments)});
    }
}

std::vector<UndefinedExpression> Definedness::undefined_over(std::span<const Interval> box) const {
  std::vector<UndefinedExpression> found;
  for (const Operation& operation : operations_) {
    const auto argument = enclose_over(operation.argument, box);
    if (argument && !enclose_over(operation.whole, box))
      found.push_back({operation.text, operation.argument_text, argument->front()});
  }
  return found;
}

std::vector<Interval> Definedness::pose_over(std::span<const Interval> box) const {
  return enclose_over(pose_, box).value_or(std::vector<Interval>{});
}

Undefined Definedness::look_at(std::span<const Interval> box) const {
  Undefined result;
  result.variables = middle_of(box);
  result.expressions = undefined_over(result.variables);
  if (result.expressions.empty()) {
    result.variables.assign(box.begin(), box.end());
    result.expressions = undefined_over(box);
  }
  result.pose = pose_over(result.variables);
  return result;
}

bool Definedness::certain_on(std::span<const Interval> box) const {
  return std::ranges::all_of(operations_, [box](const Operation& operation) {
    return enclose_over(operation.whole, box).has_value();
  });
}

Undefined find_undefined(const PreparedSearch& p, std::span<const Interval> box) {
  return Definedness(p.stages->natural_formulation()).look_at(box);
}

}  // namespace regulus::detail
