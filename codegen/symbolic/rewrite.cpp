// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/symbolic/rewrite.hpp"

#include <cstdint>
#include <optional>
#include <utility>

namespace regulus::codegen {
namespace {

/// The cheapest form offered so far. On equal width the one with fewer operations, then the first.
class Choice {
 public:
  void offer(Expression e, const char* passes) {
    const std::uint64_t width = width_cost(e);
    if (best_ && width > width_) return;
    const std::uint64_t operations = count_operations({e});
    if (best_ && width == width_ && operations >= operations_) return;
    best_ = Rewritten{std::move(e), passes};
    width_ = width;
    operations_ = operations;
  }
  [[nodiscard]] Rewritten take() { return std::move(*best_); }

 private:
  std::optional<Rewritten> best_;
  std::uint64_t width_ = 0;
  std::uint64_t operations_ = 0;
};

bool is_odd(Call function) {
  return function == Call::kSin || function == Call::kTan || function == Call::kAsin ||
         function == Call::kAtan;
}

bool is_even(Call function) { return function == Call::kCos || function == Call::kAbs; }

/// sin(−u) as −sin(u) and cos(−u) as cos(u), so that each angle has one form.
Expression symmetric_call(Call function, Expressions arguments) {
  if (!is_odd(function) && !is_even(function)) return call(function, std::move(arguments));
  const Signed argument = normalize_sign(arguments[0]);
  const Expression value = call(function, {argument.form});
  return is_odd(function) && argument.sign < 0 ? -value : value;
}

}  // namespace

Rewriter::Rewriter(const std::vector<std::string>& variables,
                   const std::vector<std::string>& points, const RewriteOptions& options)
    : options_(options), atoms_(variables, points), expander_(atoms_) {}

Rewritten Rewriter::rewrite(const Expression& e) {
  const Expression natural = prepared(e);
  const std::optional<Polynomial> p = expander_.expand(natural);
  if (!p) return {natural, "natural"};
  return best_form(*p, &natural);
}

Expression Rewriter::with_rewritten_arguments(const Expression& e) { return prepared(e); }

Polynomial Rewriter::expand(const Expression& e) {
  const Expression natural = prepared(e);
  const std::optional<Polynomial> p = expander_.expand(natural);
  return p ? *p : expander_.atom(natural);
}

Rewritten Rewriter::best_form(const Polynomial& p, const Expression* natural) {
  Choice choice;
  if (natural != nullptr) choice.offer(*natural, "natural");
  choice.offer(collect(p, atoms_), "collect");
  if (!options_.horner) return choice.take();
  choice.offer(horner(p, atoms_), "horner");
  if (!options_.trigonometric) return choice.take();
  const std::function<Expression(const Expression&)> simplify = [this](const Expression& e) {
    return simplified_argument(e);
  };
  const Polynomial merged = merge_angles(p, atoms_, expander_, simplify, {true, false});
  if (!(merged == p)) choice.offer(horner(merged, atoms_), "angles + horner");
  const Polynomial doubled = merge_angles(p, atoms_, expander_, simplify, {true, true});
  if (!(doubled == merged)) choice.offer(horner(doubled, atoms_), "double angles + horner");
  return choice.take();
}

Expression Rewriter::prepared(const Expression& e) {
  if (e.operands().empty()) return e;
  if (const auto found = prepared_.find(e); found != prepared_.end()) return found->second;
  Expressions operands;
  const bool opaque = e.kind() == Kind::kCall || (e.kind() == Kind::kPower && e.exponent() < 0);
  for (const Expression& operand : e.operands())
    operands.push_back(opaque ? rewrite(operand).expression : prepared(operand));
  Expression result;
  switch (e.kind()) {
    case Kind::kCall:
      result = symmetric_call(e.function(), std::move(operands));
      break;
    case Kind::kPower:
      result = power(operands[0], e.exponent());
      break;
    case Kind::kProduct:
      result = product(std::move(operands));
      break;
    default:
      result = sum(std::move(operands));
  }
  prepared_.emplace(e, result);
  return result;
}

Expression Rewriter::simplified_argument(const Expression& e) {
  const std::optional<Polynomial> p = expander_.expand(e);
  return p ? horner(*p, atoms_) : e;
}

}  // namespace regulus::codegen
