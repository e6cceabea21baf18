// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/formulation/matrix_parts.hpp"

#include <algorithm>
#include <utility>

namespace regulus::detail {
namespace {

/// A part counts as one motion parameter.
constexpr std::uint64_t kPartWeight = 16;

/// "cos#2".
std::string numbered(std::string name, std::size_t number) {
  name += '#';
  name += std::to_string(number);
  return name;
}

bool is_denominator(const Expression& e) {
  return e.kind() == ExpressionKind::kPower && e.exponent() < 0;
}

}  // namespace

MatrixParts::MatrixParts(const std::vector<Variable>& variables, Rewriter& rewriter,
                         Rewriter& of_parts)
    : rewriter_(rewriter),
      of_parts_(of_parts),
      widths_(variables),
      revealing_([this](const Expression& e) -> std::optional<Expression> {
        if (e.kind() != ExpressionKind::kVariable) return std::nullopt;
        const auto found = revealed_.find(e.name());
        return found == revealed_.end() ? std::nullopt : std::optional(found->second);
      }) {}

Expression MatrixParts::reveal(const Expression& e) { return revealing_.apply(e); }

Expression MatrixParts::hide(const Expression& e) {
  if (e.is_total() || !e.has_variables()) return e;
  Expressions operands;
  switch (e.kind()) {
    case ExpressionKind::kSum:
      for (const Expression& operand : e.operands()) operands.push_back(hide(operand));
      return sum(std::move(operands));
    case ExpressionKind::kProduct:
      return hide_product(e.operands());
    case ExpressionKind::kPower:
      return e.exponent() < 0 ? part(e) : power(hide(e.operands()[0]), e.exponent());
    default:
      return e.kind() == ExpressionKind::kCall && e.function() == Call::kSqrt ? root(e) : part(e);
  }
}

/// The factors with roots and quotients are one part if one of them is a denominator.
Expression MatrixParts::hide_product(const Expressions& factors) {
  Expressions total, numerators, denominators;
  for (const Expression& factor : factors)
    (factor.is_total() || !factor.has_variables() ? total
     : is_denominator(factor)                     ? denominators
                                                  : numerators)
        .push_back(factor);
  if (denominators.empty()) {
    for (const Expression& factor : numerators) total.push_back(hide(factor));
    return product(std::move(total));
  }
  const Expression numerator = product(numerators);
  if (denominators.size() == 1 && denominators[0].exponent() == -1)
    if (const auto found = find_crank(numerator, denominators[0].operands()[0])) {
      const KnownCrank& crank = known(found->crank);
      total.push_back(hide(found->factor));
      total.push_back(found->is_sine ? crank.sine : crank.cosine);
      return product(std::move(total));
    }
  denominators.push_back(numerator);
  total.push_back(part(product(std::move(denominators))));
  return product(std::move(total));
}

Expression MatrixParts::symbol(const std::string& name, const Expression& value, Rule rule) {
  revealed_.emplace(name, reveal(value));
  rules_.emplace(name, std::move(rule));
  parts_.push_back({name, value});
  rewriter_.weigh(name, kPartWeight);
  return variable(name);
}

Expression MatrixParts::part(const Expression& value) {
  if (const auto found = symbols_.find(value); found != symbols_.end()) return found->second;
  const Expression form = form_of(value);
  const std::string name = numbered("part", parts_.size() + 1);
  const Expression result = symbol(name, form, [this, value](const std::string& variable) {
    return derivative_piece(value, variable);
  });
  return symbols_.emplace(value, result).first->second;
}

Expression MatrixParts::form_of(const Expression& value) {
  return (value.is_total() ? rewriter_ : of_parts_).rewrite(value).expression;
}

Expression MatrixParts::piece(const Expression& value) {
  if (!value.has_variables()) return value;
  const Expression form = form_of(value);
  return form.is_total() && form.kind() != ExpressionKind::kSum ? form : part(value);
}

Differentiator& MatrixParts::by(const std::string& variable) {
  return by_.try_emplace(variable, variable).first->second;
}

Expression MatrixParts::derivative_piece(const Expression& value, const std::string& variable) {
  return piece(by(variable).derivative(value));
}

/// ∂√Q = (∂Q/2)/√Q.
Expression MatrixParts::root(const Expression& value) {
  if (const auto found = symbols_.find(value); found != symbols_.end()) return found->second;
  const Expression radicand = value.operands()[0];
  const std::string name = numbered("root", parts_.size() + 1);
  const Expression result =
      symbol(name, form_of(value), [this, radicand, name](const std::string& of) -> Expression {
        const Expression half = Expression(cln::cl_RA(1) / 2) * by(of).derivative(radicand);
        if (!half.has_variables() && half.is_constant(0)) return half;
        return piece(half) * power(variable(name), -1);
      });
  return symbols_.emplace(value, result).first->second;
}

const MatrixParts::KnownCrank& MatrixParts::known(const Crank& crank) {
  for (const auto& c : cranks_)
    if (c->crank.sign == crank.sign && c->crank.f == crank.f && c->crank.g == crank.g &&
        c->crank.k == crank.k)
      return *c;
  cranks_.push_back(std::make_unique<KnownCrank>());
  KnownCrank& added = *cranks_.back();
  added.crank = crank;
  added.number = cranks_.size();
  add_symbols(added);
  return added;
}

Expression MatrixParts::sharpened(const Expression& e) const {
  return substitute(e, [this](const Expression& node) -> std::optional<Expression> {
    for (const auto& c : cranks_)
      if (node == c->crank.root)
        return Expression(c->crank.root_factor) * call(Call::kSqrt, {c->squared_lever});
    return std::nullopt;
  });
}

void MatrixParts::choose_forms(KnownCrank& c) const {
  const Expression q = power(c.f, 2) + power(c.g, 2), root = call(Call::kSqrt, {q});
  c.squared_lever = q - power(c.k, 2);
  c.cosine_of_alpha = c.k * power(root, -1);
  if (!c.crank.length) return;
  const Expression length = *c.crank.length;
  const Expression m =
      rewriter_
          .rewrite(Expression(2) * length * c.crank.k - power(c.crank.f, 2) - power(c.crank.g, 2))
          .expression;
  const auto take_if_narrower = [this](Expression& form, const Expression& other) {
    if (widths_.approx_width(other) < widths_.approx_width(form)) form = other;
  };
  take_if_narrower(c.squared_lever, power(length, 2) - m - power(c.k - length, 2));
  take_if_narrower(c.cosine_of_alpha,
                   (root + m * power(root, -1)) * power(Expression(2) * length, -1));
}

void MatrixParts::choose_coordinates(const KnownCrank& c, Expression& cosine,
                                     Expression& sine) const {
  const Expression q = power(c.f, 2) + power(c.g, 2);
  const Expression W = Expression(c.crank.sign) * call(Call::kSqrt, {c.squared_lever});
  cosine = (c.k * c.f + W * c.g) * power(q, -1);
  sine = (c.k * c.g - W * c.f) * power(q, -1);
  double least = widths_.approx_width(cosine) + widths_.approx_width(sine);
  const Expression alpha = Expression(c.crank.sign) * call(Call::kAcos, {c.cosine_of_alpha});
  // atan2 has no value on its cut, so the direction of the cut is one that (f, g) never has. The
  // quarter turns are added exactly: cos(π/2 + t) = −sin t.
  const Expression directions[4][2] = {{c.f, c.g}, {c.g, -c.f}, {-c.f, -c.g}, {-c.g, c.f}};
  for (int turns = 0; turns < 4; ++turns) {
    const auto& [abscissa, ordinate] = directions[turns];
    const std::optional<Interval> range = widths_.over_motion(abscissa);
    if (!range || !(range->lo > 0)) continue;
    const Expression angle = call(Call::kAtan2, {ordinate, abscissa}) - alpha;
    const Expression u = call(Call::kCos, {angle}), v = call(Call::kSin, {angle});
    const Expression turned[4][2] = {{u, v}, {-v, u}, {-u, -v}, {v, -u}};
    const double width =
        widths_.approx_width(turned[turns][0]) + widths_.approx_width(turned[turns][1]);
    if (!(width < least)) continue;
    least = width;
    cosine = turned[turns][0];
    sine = turned[turns][1];
  }
}

void MatrixParts::add_symbols(KnownCrank& c) {
  c.f = form_of(c.crank.f);
  c.g = form_of(c.crank.g);
  c.k = form_of(c.crank.k);
  choose_forms(c);
  Expression cosine, sine;
  choose_coordinates(c, cosine, sine);
  const KnownCrank* of = &c;
  c.cosine = symbol(numbered("cos", c.number), cosine,
                    [this, of](const std::string& v) { return -of->sine * turn(*of, v); });
  c.sine = symbol(numbered("sin", c.number), sine,
                  [this, of](const std::string& v) { return of->cosine * turn(*of, v); });
  c.lever = symbol(numbered("lever", c.number),
                   Expression(c.crank.sign) * call(Call::kSqrt, {c.squared_lever}),
                   [this, of](const std::string& v) { return lever_derivative(*of, v); });
  if (!c.crank.length) return;
  const Expression length = *c.crank.length;
  c.along =
      symbol(numbered("rod_f", c.number), c.f - length * c.cosine, [=, this](const std::string& v) {
        return derivative_piece(of->crank.f, v) + length * of->sine * turn(*of, v);
      });
  c.across =
      symbol(numbered("rod_g", c.number), c.g - length * c.sine, [=, this](const std::string& v) {
        return derivative_piece(of->crank.g, v) - length * of->cosine * turn(*of, v);
      });
}

Expression MatrixParts::turn(const KnownCrank& c, const std::string& of) {
  const std::string name = numbered("turn", c.number) + "#" + of;
  if (revealed_.count(name) != 0) return variable(name);
  const Expression value = turn_value(c, of);
  if (value.is_constant(0)) return value;
  return symbol(name, value, [this, crank = &c, of](const std::string& v) {
    return turn_derivative(*crank, of, v);
  });
}

/// c·∂k − f·∂f − g·∂g, or ∂k.
Expression MatrixParts::turn_value(const KnownCrank& c, const std::string& of) {
  const Expression f = derivative_piece(c.crank.f, of), g = derivative_piece(c.crank.g, of);
  const Expression slope = by(of).derivative(c.crank.k);
  if (!c.crank.length) {
    const Expression turned = piece(slope) - c.cosine * f - c.sine * g;
    return turned.is_constant(0) ? turned : turned * power(c.lever, -1);
  }
  const Expression length = *c.crank.length;
  const Expression rest = length * slope - c.crank.f * by(of).derivative(c.crank.f) -
                          c.crank.g * by(of).derivative(c.crank.g);
  const Expression turned = c.along * f + c.across * g + piece(rest);
  return turned.is_constant(0) ? turned : turned * power(length * c.lever, -1);
}

Expression MatrixParts::lever_derivative(const KnownCrank& c, const std::string& v) {
  return c.cosine * derivative_piece(c.crank.g, v) - c.sine * derivative_piece(c.crank.f, v) -
         part(c.crank.k) * turn(c, v);
}

Expression MatrixParts::turn_derivative(const KnownCrank& c, const std::string& first,
                                        const std::string& second) {
  const std::string name =
      numbered("turn", c.number) + "#" + std::min(first, second) + "#" + std::max(first, second);
  if (revealed_.count(name) != 0) return variable(name);
  // The value is (numerator)/(c·W); the quotient rule with the value itself is shorter.
  const Expression value = turn_value(c, first);
  Expressions numerator, denominator;
  const bool is_product = value.kind() == ExpressionKind::kProduct;  // it may be 1/W
  for (const Expression& factor : is_product ? value.operands() : Expressions{value})
    (is_denominator(factor) ? denominator : numerator).push_back(factor);
  const Expression slope = Differentiator(second, this).derivative(product(numerator));
  const Expression result = slope * product(denominator) -
                            turn(c, first) * lever_derivative(c, second) * power(c.lever, -1);
  // 0/W is 0, but not where it is undefined, so it stays a quotient.
  if (rewriter_.expand(result).is_zero()) return Expression(0);
  return symbol(name, result, [this, result](const std::string& v) {
    return Differentiator(v, this).derivative(result);
  });
}

Expression MatrixParts::derivative(const std::string& symbol, const std::string& variable) {
  const auto rule = rules_.find(symbol);
  if (rule == rules_.end()) return Expression(0);
  const auto key = std::make_pair(symbol, variable);
  if (const auto found = derivatives_.find(key); found != derivatives_.end()) return found->second;
  const Expression result = Rule(rule->second)(variable);
  return derivatives_.emplace(key, result).first->second;
}

}  // namespace regulus::detail
