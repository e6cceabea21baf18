// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/lowering.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

std::unordered_map<std::string, std::uint32_t> numbered(const std::vector<std::string>& names) {
  std::unordered_map<std::string, std::uint32_t> result;
  for (const std::string& name : names)
    result.emplace(name, static_cast<std::uint32_t>(result.size()));
  return result;
}

std::uint32_t number_of(const std::unordered_map<std::string, std::uint32_t>& numbers,
                        const std::string& name) {
  const auto found = numbers.find(name);
  if (found == numbers.end()) throw InternalError("undeclared symbol " + name);
  return found->second;
}

Op operation_of(Call function) {
  static constexpr std::array<Op, 11> kOperations = {Op::kSqrt, Op::kSin,  Op::kCos,  Op::kTan,
                                                     Op::kAsin, Op::kAcos, Op::kAtan, Op::kAtan2,
                                                     Op::kExp,  Op::kLog,  Op::kAbs};
  return kOperations[static_cast<std::size_t>(function)];
}

/// Returns the operands without variables, then the others.
Expressions fixed_first(const Expressions& operands) {
  Expressions ordered;
  ordered.reserve(operands.size());
  for (const bool has_variables : {false, true})
    for (const Expression& e : operands)
      if (e.has_variables() == has_variables) ordered.push_back(e);
  return ordered;
}

/// Returns the order of evaluation of a sum: terms without variables come first and are added up
/// separately; a term that is added, not subtracted, leads if there is one.
Expressions summation_order(const Expressions& terms) {
  Expressions ordered = fixed_first(terms);
  const bool fixed = !ordered.front().has_variables();
  const auto end = std::find_if(ordered.begin(), ordered.end(), [fixed](const Expression& t) {
    return t.has_variables() == fixed;
  });
  const auto lead = std::find_if(ordered.begin(), end,
                                 [](const Expression& t) { return !minusp(coefficient_of(t)); });
  if (lead != end) std::rotate(ordered.begin(), lead, lead + 1);
  return ordered;
}

}  // namespace

Lowering::Lowering(const std::vector<std::string>& variables,
                   const std::vector<std::string>& points, WorkMeter* meter)
    : builder_(variables, points),
      meter_(meter),
      inputs_(numbered(variables)),
      points_(numbered(points)) {}

NodeId Lowering::output(const Expression& e) { return output_where_defined(e, {}); }

NodeId Lowering::output_where_defined(const Expression& e, const Expressions& conditions) {
  const NodeId node = lower(e);
  NodeId result = node;
  // 0·f is the number 0 where f is defined, and undefined elsewhere.
  for (const Expression& condition : conditions)
    result = builder_.add(result, builder_.multiply(builder_.constant(0), lower(condition)));
  builder_.output(result);
  return node;
}

void Lowering::output_moved(NodeId node, std::uint32_t further) {
  const std::size_t before = builder_.size();
  builder_.output(builder_.moved(node, further));
  spend(meter_, 1 + builder_.size() - before);
}

NodeId Lowering::lower(const Expression& e) {
  if (const auto found = known_.find(e); found != known_.end()) return found->second;
  spend(meter_, 1 + e.operands().size());
  const NodeId result = lowered(e);
  known_.emplace(e, result);
  return result;
}

NodeId Lowering::lowered(const Expression& e) {
  switch (e.kind()) {
    case ExpressionKind::kConstant:
      return builder_.constant(e.value());
    case ExpressionKind::kNumberPi:
      return builder_.pi();
    case ExpressionKind::kPoint:
      return builder_.point(number_of(points_, e.name()));
    case ExpressionKind::kVariable:
      return builder_.input(number_of(inputs_, e.name()));
    case ExpressionKind::kPower:
      return builder_.power(lower(e.operands()[0]), e.exponent());
    case ExpressionKind::kCall:
      return lower_call(e);
    case ExpressionKind::kProduct:
      return lower_product(e.operands());
    case ExpressionKind::kSum:
      return lower_sum(e.operands());
  }
  throw InternalError("an expression of no kind");
}

NodeId Lowering::lower_call(const Expression& e) {
  const NodeId argument = lower(e.operands()[0]);
  if (e.function() == Call::kAtan2) return builder_.atan2(argument, lower(e.operands()[1]));
  return builder_.call(operation_of(e.function()), argument);
}

NodeId Lowering::lower_product(const Expressions& factors) {
  // Constants and entries of K precede variables in the canonical order, but sums of them do not.
  std::optional<NodeId> numerator, denominator;
  const auto multiply_into = [this](std::optional<NodeId>& to, NodeId factor) {
    to = to ? builder_.multiply(*to, factor) : factor;
  };
  for (const Expression& factor : fixed_first(factors)) {
    if (factor.kind() == ExpressionKind::kPower && factor.exponent() < 0)
      multiply_into(denominator, lower(power(factor.operands()[0], -factor.exponent())));
    else
      multiply_into(numerator, lower(factor));
  }
  if (!numerator) numerator = builder_.constant(1);
  return denominator ? builder_.divide(*numerator, *denominator) : *numerator;
}

NodeId Lowering::lower_sum(const Expressions& terms) {
  std::optional<NodeId> result;
  for (const Expression& term : summation_order(terms)) {
    const bool negative = minusp(coefficient_of(term));
    const NodeId magnitude = lower(negative ? divide_by(term, -1) : term);
    if (!result)
      result = negative ? builder_.negate(magnitude) : magnitude;
    else
      result = negative ? builder_.subtract(*result, magnitude) : builder_.add(*result, magnitude);
  }
  return *result;
}

}  // namespace regulus::detail
