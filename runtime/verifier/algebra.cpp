// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/algebra.hpp"

#include <algorithm>

#include "runtime/verifier/evaluation.hpp"

namespace regulus::verifier {
namespace {

constexpr std::uint64_t kProductsOfValue = 1 << 16;
constexpr int kMostPowerOfSum = 64;
constexpr std::size_t kMostOrder = 8;

bool is_single(const Polynomial& p) { return p.terms().size() == 1; }

/// Returns |factor of the first term|.
Rational content(const Polynomial& p) {
  Rational result;
  fmpq_abs(result.get(), p.terms().begin()->second.get());
  return result;
}

std::string key_of(std::initializer_list<std::string> parts) {
  std::string result;
  for (const std::string& part : parts) result += part;
  return result;
}

Rational inverted(const Rational& x) { return Rational(1) / x; }

}  // namespace

const Polynomial& Algebra::of(NodeId id) {
  if (const auto known = known_.find(id); known != known_.end()) return known->second;
  // Operands come first, so the recursion is not as deep as the expression.
  for (const NodeId part : ingredients(graph_, {id})) {
    if (known_.contains(part)) continue;
    if (const auto own = std::find(whole_.begin(), whole_.end(), part); own != whole_.end()) {
      known_.emplace(part, variable(-1 - int(own - whole_.begin())));
      continue;
    }
    const Node node = graph_.nodes()[std::size_t(part)];
    if (node.op == Op::kVariable && std::size_t(node.a) < values_.size() &&
        values_[std::size_t(node.a)] != kNoNode) {
      // The value of a variable is an expression without variables.
      Polynomial value = of(values_[std::size_t(node.a)]);
      known_.emplace(part, std::move(value));
      continue;
    }
    Polynomial value = compute(node);
    known_.emplace(part, std::move(value));
  }
  return known_.at(id);
}

Polynomial Algebra::compute(const Node& node) {
  const auto a = [&]() -> const Polynomial& { return known_.at(node.a); };
  const auto b = [&]() -> const Polynomial& { return known_.at(node.b); };
  switch (node.op) {
    case Op::kConstant:
      return Polynomial(graph_.rational(node.a));
    case Op::kPi:
      return Polynomial::atom(number_of({Atom::Kind::kPi, Op::kPi, 0, {}, {}}, "pi"));
    case Op::kVariable:
      return variable(node.a);
    case Op::kNegate:
      return a().scaled(Rational(-1));
    case Op::kAdd:
      return sum(a(), b(), 1);
    case Op::kSubtract:
      return sum(a(), b(), -1);
    case Op::kMultiply:
      return node.a == node.b ? power(a(), 2) : product(a(), b());
    case Op::kDivide:
      return product(a(), inverse_of(node.b));
    case Op::kPower:
      return power(a(), node.b);
    case Op::kAtan2:
      return angle_of_two(a(), b());
    default:
      return function(node.op, a());
  }
}

Polynomial Algebra::variable(int number) {
  return Polynomial::atom(number_of({Atom::Kind::kVariable, Op::kVariable, number, {}, {}},
                                    key_of({"v", std::to_string(number)})));
}

Polynomial Algebra::sum(const Polynomial& x, const Polynomial& y, long factor) {
  Polynomial result = x;
  budget_.spend(x.terms().size() + y.terms().size());
  for (const auto& [product, own] : y.terms()) result.add(product, own * Rational(factor));
  return result;
}

Polynomial Algebra::product(const Polynomial& x, const Polynomial& y) {
  return reduced(multiply(x, y, budget_));
}

Polynomial Algebra::power(const Polynomial& x, int exponent) {
  if (!is_single(x) && !x.is_zero()) {
    if (form_ == Form::kPlain && exponent % 2 == 0)
      return Polynomial::atom(number_of({Atom::Kind::kPower, Op::kPower, exponent, x, {}},
                                        key_of({"p", std::to_string(exponent), "(", x.key()})));
    if (exponent > kMostPowerOfSum) throw TooLarge("exact algebra takes too high a power");
  } else if (exponent > kMostDegree) {
    throw TooLarge("exact algebra takes too high a power");
  }
  Polynomial result = x;
  for (int i = 1; i < exponent; ++i) result = product(result, x);
  return result;
}

/// A product and a power are inverted factor by factor, so that 1/d² and (1/d)² have one form.
Polynomial Algebra::inverse_of(NodeId divisor) {
  const Node node = graph_.nodes()[std::size_t(divisor)];
  const bool is_whole = std::find(whole_.begin(), whole_.end(), divisor) != whole_.end();
  if (form_ == Form::kFull && !is_whole && !known_.at(divisor).is_zero()) {
    if (node.op == Op::kPower) return power(inverse_of(node.a), node.b);
    if (node.op == Op::kMultiply) return product(inverse_of(node.a), inverse_of(node.b));
  }
  return inverse(known_.at(divisor));
}

/// Inverts c·∏ atoms directly; other divisors, without their content, become atoms.
Polynomial Algebra::inverse(const Polynomial& x) {
  if (x.is_zero()) throw TooLarge("exact algebra meets a division by 0");
  if (is_single(x)) {
    const auto& [powers, factor] = *x.terms().begin();
    Polynomial result(inverted(factor));
    for (const auto& [number, exponent] : powers)
      result = product(result, Polynomial::atom(number, -exponent));
    return result;
  }
  budget_.spend(x.terms().size());
  const Rational size = content(x);
  const Polynomial divisor = x.scaled(inverted(size));
  const int number =
      number_of({Atom::Kind::kDivisor, Op::kDivide, 0, divisor, {}}, key_of({"d(", divisor.key()}));
  return Polynomial::atom(number, -1).scaled(inverted(size));
}

int Algebra::number_of(Atom atom, const std::string& key) {
  const auto [place, is_new] = numbers_.try_emplace(key, int(atoms_.size()));
  if (is_new) atoms_.push_back(std::move(atom));
  return place->second;
}

int Algebra::atom_of(Op op, const Polynomial& argument, const Polynomial& second) {
  budget_.spend(argument.terms().size() + second.terms().size());
  return number_of({Atom::Kind::kFunction, op, 0, argument, second},
                   key_of({"f", std::to_string(int(op)), "(", argument.key(), ",", second.key()}));
}

/// Returns true if a relation replaces this power of an atom by a polynomial of smaller atoms.
bool Algebra::reducible(const std::pair<int, int>& factor) const {
  const Atom& atom = atoms_[std::size_t(factor.first)];
  if (atom.kind == Atom::Kind::kDivisor) return factor.second > 0;
  if (atom.kind != Atom::Kind::kFunction) return false;
  if (atom.op == Op::kSqrt || atom.op == Op::kAbs) return factor.second < 0 || factor.second > 1;
  return atom.op == Op::kCos && form_ == Form::kFull && factor.second > 1;
}

Polynomial Algebra::replacement(const std::pair<int, int>& factor) {
  const auto [number, exponent] = factor;
  const Atom atom = atoms_[std::size_t(number)];
  if (atom.kind == Atom::Kind::kDivisor) return power(atom.argument, exponent);
  // Replace atom² by `square`; an odd power keeps one factor `atom`.
  const bool odd = exponent % 2 != 0;
  const int pairs = (exponent - (odd ? 1 : 0)) / 2;
  Polynomial square = atom.argument;
  if (atom.op == Op::kAbs) square = product(atom.argument, atom.argument);
  if (atom.op == Op::kCos) {
    square = Polynomial(1);
    square.add({{atom.sine, 2}}, Rational(-1));
  }
  if (pairs < 0) square = inverse(square);
  Polynomial result = odd ? Polynomial::atom(number) : Polynomial(1);
  for (int i = 0; i < std::abs(pairs); ++i) result = product(result, square);
  return result;
}

Polynomial Algebra::reduced(const Polynomial& p) {
  const auto first = [this](const PowerProduct& powers) {
    return std::find_if(powers.begin(), powers.end(),
                        [this](const auto& factor) { return reducible(factor); });
  };
  Polynomial result;
  for (const auto& [powers, factor] : p.terms()) {
    const auto found = first(powers);
    if (found == powers.end()) {
      result.add(powers, factor);
      continue;
    }
    PowerProduct rest = powers;
    rest.erase(rest.begin() + (found - powers.begin()));
    Polynomial others;
    others.add(rest, factor);
    budget_.spend(1);
    result.add(product(others, replacement(*found)));
  }
  return result;
}

/// The last divisor comes first, because the divisors in a divisor are earlier atoms.
Polynomial Algebra::cleared(Polynomial p) {
  for (int number = int(atoms_.size()); !p.is_zero() && number-- > 0;) {
    int most = 0;
    for (const auto& [powers, factor] : p.terms())
      for (const auto& [other, exponent] : powers)
        if (other == number) most = std::max(most, -exponent);
    if (most == 0) continue;
    Polynomial whole;
    for (const auto& [powers, factor] : p.terms()) {
      Polynomial term;
      term.add(multiply(powers, {{number, most}}), factor);
      whole.add(reduced(term));
    }
    p = std::move(whole);
  }
  return p;
}

bool Algebra::is_constant(const PowerProduct& powers) const {
  return std::all_of(powers.begin(), powers.end(), [this](const auto& factor) {
    const Atom& atom = atoms_[std::size_t(factor.first)];
    if (atom.kind == Atom::Kind::kVariable) return false;
    return is_constant(atom.argument) && is_constant(atom.second);
  });
}

bool Algebra::is_constant(const Polynomial& p) const {
  return std::all_of(p.terms().begin(), p.terms().end(),
                     [this](const auto& term) { return is_constant(term.first); });
}

/// Computes the minors of the first rows, by the set of their columns.
Polynomial Algebra::determinant(const std::vector<NodeId>& matrix, std::size_t order) {
  if (order > kMostOrder) throw TooLarge("exact algebra takes too large a matrix");
  std::map<unsigned, Polynomial> minors;
  minors.emplace(0U, Polynomial(1));
  for (std::size_t row = 0; row < order; ++row) {
    std::map<unsigned, Polynomial> next;
    for (const auto& [columns, minor] : minors)
      for (std::size_t column = 0; column < order; ++column) {
        const unsigned bit = 1U << column;
        const Polynomial& entry = of(matrix[row * order + column]);
        if ((columns & bit) != 0 || entry.is_zero() || minor.is_zero()) continue;
        const int later = __builtin_popcount(columns >> column);
        next[columns | bit].add(product(minor, entry).scaled(Rational(later % 2 == 0 ? 1 : -1)));
      }
    minors = std::move(next);
  }
  return minors.empty() ? Polynomial() : minors.begin()->second;
}

NodeId Algebra::expression(const Polynomial& p) {
  NodeId total = kNoNode;
  for (const auto& [powers, factor] : p.terms()) {
    NodeId above = kNoNode, below = kNoNode;
    for (const auto& [number, exponent] : powers) {
      const int times = std::abs(exponent);
      NodeId power = expression_of_atom(number);
      if (times > 1) power = graph_.add(Op::kPower, power, times);
      NodeId& side = exponent > 0 ? above : below;
      side = side == kNoNode ? power : graph_.add(Op::kMultiply, side, power);
    }
    if (above == kNoNode || !(factor == Rational(1))) {
      const NodeId number = graph_.number(factor);
      above = above == kNoNode ? number : graph_.add(Op::kMultiply, number, above);
    }
    if (below != kNoNode) above = graph_.add(Op::kDivide, above, below);
    total = total == kNoNode ? above : graph_.add(Op::kAdd, total, above);
  }
  return total == kNoNode ? graph_.number("0") : total;
}

NodeId Algebra::nested_expression(const Polynomial& p) {
  std::map<int, std::size_t> terms_with;
  for (const auto& [powers, factor] : p.terms())
    for (const auto& [number, exponent] : powers)
      if (exponent > 0) ++terms_with[number];
  const auto most = std::max_element(terms_with.begin(), terms_with.end(),
                                     [](auto& x, auto& y) { return x.second < y.second; });
  if (most == terms_with.end() || most->second < 2) return expression(p);
  Polynomial inner, rest;
  for (const auto& [powers, factor] : p.terms()) {
    PowerProduct left = powers;
    const auto at = std::find_if(left.begin(), left.end(),
                                 [&](const auto& power) { return power.first == most->first; });
    if (at == left.end() || at->second <= 0) {
      rest.add(powers, factor);
      continue;
    }
    if (--at->second == 0) left.erase(at);
    inner.add(left, factor);
  }
  const NodeId product =
      graph_.add(Op::kMultiply, expression_of_atom(most->first), nested_expression(inner));
  return rest.is_zero() ? product : graph_.add(Op::kAdd, product, nested_expression(rest));
}

NodeId Algebra::expression_of_atom(int number) {
  const Atom atom = atoms_[std::size_t(number)];
  switch (atom.kind) {
    case Atom::Kind::kVariable:
      return atom.number < 0 ? -1 - atom.number : graph_.add(Op::kVariable, atom.number);
    case Atom::Kind::kPi:
      return graph_.add(Op::kPi);
    case Atom::Kind::kPower:
      return graph_.add(Op::kPower, expression(atom.argument), atom.number);
    case Atom::Kind::kDivisor:
      return expression(atom.argument);
    case Atom::Kind::kFunction:
      break;
  }
  const NodeId argument = expression(atom.argument);
  return graph_.add(atom.op, argument, atom.op == Op::kAtan2 ? expression(atom.second) : 0);
}

std::optional<Rational> exact_value(Graph& graph, NodeId expression) {
  AlgebraBudget budget(kProductsOfValue);
  const std::vector<NodeId> none;
  try {
    Algebra algebra(graph, none, Algebra::Form::kFull, budget);
    const Polynomial& value = algebra.of(expression);
    if (value.is_constant()) return value.constant();
  } catch (const TooLarge&) {
    return std::nullopt;
  }
  return std::nullopt;
}

bool certain_equal(Graph& graph, NodeId a, NodeId b, std::uint64_t products) {
  if (a == b) return true;
  const std::vector<NodeId> none;
  for (const auto form : {Algebra::Form::kPlain, Algebra::Form::kFull}) try {
      AlgebraBudget budget(products);
      Algebra algebra(graph, none, form, budget);
      if (algebra.vanishes(algebra.of(graph.add(Op::kSubtract, a, b)))) return true;
    } catch (const TooLarge&) {
      return false;
    }
  return false;
}

}  // namespace regulus::verifier
