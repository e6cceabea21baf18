// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/rewrite.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

namespace regulus::detail {
namespace {

/// Keeps the cheapest form so far. For equal width it keeps the one with fewer operations, then the
/// first.
class Choice {
 public:
  explicit Choice(const Weights& weights) : weights_(weights) {}

  void offer(Expression e, std::string passes) {
    const std::uint64_t width = width_cost(e, weights_);
    if (best_ && width > width_) return;
    std::optional<std::uint64_t> operations;
    if (best_ && width == width_) {
      if (!operations_) operations_ = count_operations({best_->expression});
      operations = count_operations({e});
      if (*operations >= *operations_) return;
    }
    best_ = Rewritten{std::move(e), std::move(passes)};
    width_ = width;
    operations_ = operations;
  }
  [[nodiscard]] Rewritten take() { return std::move(*best_); }

 private:
  const Weights& weights_;
  std::optional<Rewritten> best_;
  std::uint64_t width_ = 0;
  std::optional<std::uint64_t> operations_;  // of the best form, if they were counted
};

void offer_forms(Choice& choice, const Polynomial& p, const AtomTable& atoms,
                 const RewriteOptions& rewriting, const std::string& prefix) {
  const bool nest = rewriting.rewrite && rewriting.horner && can_nest(p);
  if (!nest) return choice.offer(collect(p, atoms), prefix + "collect");
  HornerOptions options = rewriting.nesting;
  options.order = HornerOrder::kMostFrequent;
  choice.offer(horner(p, atoms, options), prefix + "horner");
  options.order = HornerOrder::kVariablesFirst;
  choice.offer(horner(p, atoms, options), prefix + "horner, variables first");
}

bool is_odd(Call function) {
  return function == Call::kSin || function == Call::kTan || function == Call::kAsin ||
         function == Call::kAtan;
}

bool is_even(Call function) { return function == Call::kCos || function == Call::kAbs; }

/// Writes sin(−u) as −sin(u) and cos(−u) as cos(u), so that each angle has one form.
Expression symmetric_call(Call function, Expressions arguments) {
  if (!is_odd(function) && !is_even(function)) return call(function, std::move(arguments));
  const Signed argument = normalize_sign(arguments[0]);
  const Expression value = call(function, {argument.form});
  return is_odd(function) && argument.sign < 0 ? -value : value;
}

bool evidently_nonnegative(const Expression& e) {
  const auto all_operands = [&e] {
    return std::all_of(e.operands().begin(), e.operands().end(), evidently_nonnegative);
  };
  switch (e.kind()) {
    case ExpressionKind::kConstant:
      return !minusp(e.value());
    case ExpressionKind::kNumberPi:
      return true;
    case ExpressionKind::kPower:
      return e.exponent() % 2 == 0 || all_operands();
    case ExpressionKind::kCall:
      return e.function() == Call::kSqrt || e.function() == Call::kExp ||
             e.function() == Call::kAbs;
    case ExpressionKind::kProduct:
    case ExpressionKind::kSum:
      return all_operands();
    default:
      return false;
  }
}

}  // namespace

Rewriter::Rewriter(const std::vector<std::string>& variables,
                   const std::vector<std::string>& points, const RewriteOptions& options,
                   WorkMeter* meter)
    : options_(options),
      atoms_(variables, points, meter),
      expander_(atoms_, options.most_terms, options.squares_roots) {}

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
  Choice choice(options_.weights);
  if (natural != nullptr) choice.offer(*natural, "natural");
  if (natural != nullptr && !options_.rewrite) return choice.take();
  offer_forms(choice, p, atoms_, options_, "");
  if (options_.rewrite && options_.trigonometric) {
    const Polynomial merged = merge(p, false);
    if (!(merged == p)) offer_forms(choice, merged, atoms_, options_, "angles + ");
    const Polynomial doubled = merge(p, true);
    if (!(doubled == merged)) offer_forms(choice, doubled, atoms_, options_, "double angles + ");
  }
  return choice.take();
}

Rewritten Rewriter::nested_form(const Polynomial& p) {
  Choice choice(options_.weights);
  offer_forms(choice, p, atoms_, options_, "");
  return choice.take();
}

Rewritten Rewriter::quick_form(const Polynomial& p) {
  if (!options_.rewrite || !options_.horner) return {collect(p, atoms_), "collect"};
  return {horner(p, atoms_, options_.nesting), "horner"};
}

Polynomial Rewriter::merge(const Polynomial& p, bool double_angles) {
  const auto simplify = [this](const Expression& e) { return simplified_argument(e); };
  return merge_angles(p, atoms_, expander_, simplify, {true, double_angles});
}

Expression Rewriter::prepared(const Expression& e) {
  if (e.operands().empty()) return e;
  if (const auto found = prepared_.find(e); found != prepared_.end()) return found->second;
  atoms_.spend(1 + e.operands().size());
  const bool opaque = e.kind() == ExpressionKind::kCall || e.kind() == ExpressionKind::kPower;
  Expressions operands;
  for (const Expression& operand : e.operands())
    operands.push_back(opaque ? argument_form(operand) : prepared(operand));
  Expression result;
  switch (e.kind()) {
    case ExpressionKind::kCall:
      result = symmetric_call(e.function(), std::move(operands));
      break;
    case ExpressionKind::kPower:
      result = power(e.exponent() % 2 == 0 ? normalize_sign(operands[0]).form : operands[0],
                     e.exponent());
      break;
    case ExpressionKind::kProduct:
      result = product(std::move(operands));
      break;
    default:
      result = sum(std::move(operands));
  }
  prepared_.emplace(e, result);
  return result;
}

Expression Rewriter::argument_form(const Expression& e) {
  // A root or logarithm of a sum of squares is certainly defined only while the squares are
  // visible.
  return evidently_nonnegative(e) ? prepared(e) : rewrite(e).expression;
}

Expression Rewriter::simplified_argument(const Expression& e) {
  const std::optional<Polynomial> p = expander_.expand(e);
  return p ? horner(*p, atoms_) : e;
}

}  // namespace regulus::detail
