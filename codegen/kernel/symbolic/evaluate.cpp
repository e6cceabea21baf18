// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/evaluate.hpp"

#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "codegen/kernel/symbolic/print.hpp"

namespace regulus::detail {
namespace {

class Evaluator {
 public:
  explicit Evaluator(const ValueOf& known) : known_(known) {}

  cln::cl_RA value(const Expression& e) {
    if (const auto found = memo_.find(e.identity()); found != memo_.end()) return found->second;
    const std::optional<cln::cl_RA> given = known_(e);
    const cln::cl_RA result = given ? *given : computed(e);
    memo_.emplace(e.identity(), result);
    return result;
  }

 private:
  cln::cl_RA computed(const Expression& e) {
    switch (e.kind()) {
      case ExpressionKind::kConstant:
        return e.value();
      case ExpressionKind::kPower:
        return power_value(value(e.operands()[0]), e.exponent());
      case ExpressionKind::kCall:
        return call_value(e);
      case ExpressionKind::kProduct: {
        cln::cl_RA result = 1;
        for (const Expression& factor : e.operands()) result = result * value(factor);
        return result;
      }
      case ExpressionKind::kSum: {
        cln::cl_RA result = 0;
        for (const Expression& term : e.operands()) result = result + value(term);
        return result;
      }
      default:
        throw std::domain_error("no value for " + to_string(e));
    }
  }

  static cln::cl_RA power_value(const cln::cl_RA& base, int exponent) {
    if (exponent < 0 && zerop(base)) throw std::domain_error("division by zero");
    return cln::expt(base, exponent);
  }

  cln::cl_RA call_value(const Expression& e) {
    const cln::cl_RA argument = value(e.operands()[0]);
    if (e.function() == Call::kAbs) return cln::abs(argument);
    cln::cl_RA root = 0;
    if (e.function() == Call::kSqrt && cln::sqrtp(argument, &root)) return root;
    throw std::domain_error("no rational value for " + to_string(e));
  }

  const ValueOf& known_;
  std::unordered_map<const void*, cln::cl_RA> memo_;
};

}  // namespace

cln::cl_RA evaluate(const Expression& expression, const ValueOf& known) {
  return Evaluator(known).value(expression);
}

const Expression& Replacer::apply(const Expression& e) {
  if (const auto found = known_.find(e.identity()); found != known_.end())
    return found->second.result;
  const std::optional<Expression> given = replacement_(e);
  Expression result = given ? *given : rebuilt(e);
  return known_.emplace(e.identity(), Known{e, std::move(result)}).first->second.result;
}

Expression Replacer::rebuilt(const Expression& e) {
  if (e.operands().empty()) return e;
  Expressions operands;
  operands.reserve(e.operands().size());
  bool changed = false;
  for (const Expression& operand : e.operands()) {
    operands.push_back(apply(operand));
    changed = changed || operands.back().identity() != operand.identity();
  }
  if (!changed) return e;
  switch (e.kind()) {
    case ExpressionKind::kPower:
      return power(operands[0], e.exponent());
    case ExpressionKind::kCall:
      return call(e.function(), std::move(operands));
    case ExpressionKind::kProduct:
      return product(std::move(operands));
    default:
      return sum(std::move(operands));
  }
}

Expression substitute(const Expression& expression, const ReplacementOf& replacement) {
  return Replacer(replacement).apply(expression);
}

Expressions substitute(const Expressions& expressions, const ReplacementOf& replacement) {
  Replacer replacer(replacement);
  Expressions result;
  result.reserve(expressions.size());
  for (const Expression& e : expressions) result.push_back(replacer.apply(e));
  return result;
}

}  // namespace regulus::detail
