// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/definedness.hpp"

#include <algorithm>

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/equality.hpp"

namespace regulus::verifier {
namespace {

constexpr std::uint64_t kProductsOfConditions = 1 << 22;  ///< for all conditions of a question
constexpr long kBitsOfValue = 2048;
using Kind = Need::Kind;

/// Returns p/|first factor|, or with the first factor 1.
Polynomial normalized(const Polynomial& p, bool any_sign) {
  Rational size = p.terms().begin()->second;
  if (!any_sign) fmpq_abs(size.get(), size.get());
  return p.scaled(Rational(1) / size);
}

const char* words_of_need(Kind kind) {
  switch (kind) {
    case Kind::kNonzero:
      return "a division by an expression that may be 0";
    case Kind::kNonnegative:
      return "a root of an expression that may be negative";
    case Kind::kPositive:
      return "a logarithm, a power or a factor that must be positive";
    case Kind::kWithinOne:
      return "an arc sine or cosine";
    case Kind::kNoPole:
      return "a tangent";
    case Kind::kOffCut:
      return "an atan2";
  }
  return "";
}

}  // namespace

std::vector<Need> Definedness::needs_of(NodeId root) {
  std::vector<Need> needs = all_needs_of(root);
  std::erase_if(needs, [this](const Need& need) { return is_certain(need); });
  return needs;
}

std::vector<Need> Definedness::all_needs_of(NodeId root) {
  std::vector<Need> needs;
  for (const NodeId id : ingredients(q_.graph, {root})) {
    const Node node = q_.graph.nodes()[std::size_t(id)];
    if (form_.is_constant(id) && has_value(id)) continue;
    if (node.op == Op::kDivide) needs.push_back({Kind::kNonzero, node.b});
    if (node.op == Op::kSqrt) needs.push_back({Kind::kNonnegative, node.a});
    if (node.op == Op::kLog) needs.push_back({Kind::kPositive, node.a});
    if (node.op == Op::kAsin || node.op == Op::kAcos) needs.push_back({Kind::kWithinOne, node.a});
    if (node.op == Op::kTan) needs.push_back({Kind::kNoPole, node.a});
    if (node.op == Op::kAtan2) needs.push_back({Kind::kOffCut, node.a, node.b});
  }
  return needs;
}

bool Definedness::has_value(NodeId constant) const {
  return evaluate(q_.graph, {constant}, {}, kBitsOfValue).has_value();
}

bool Definedness::is_certain(const Need& need) {
  switch (need.kind) {
    case Kind::kNonzero:
      return form_.is_nonzero(need.operand);
    case Kind::kNonnegative:
      return form_.has_sign(need.operand, 1, false);
    case Kind::kPositive:
      return form_.has_sign(need.operand, 1, true);
    case Kind::kOffCut:
      return form_.has_sign(need.second, 1, true) || form_.is_nonzero(need.operand);
    default:
      return false;
  }
}

/// One algebra for all conditions, so that equal atoms have equal numbers.
void Definedness::begin_algebra() {
  restart_algebra();
  std::vector<NodeId> operands;
  const auto collect = [&operands](const std::vector<Need>& needs) {
    for (const Need& need : needs) {
      operands.push_back(need.operand);
      if (need.second != kNoNode) operands.push_back(need.second);
    }
  };
  for (const auto& needs : claims_) collect(needs);
  for (const Named& line : lines_) collect(line.needs);
  for (const Named& place : wanted_) collect(place.needs);
  try {
    algebra_->find_units(operands);
  } catch (const TooLarge&) {
    restart_algebra();  // Units are found as they come: an angle may be written in two ways.
  }
}

void Definedness::restart_algebra() {
  budget_ = std::make_unique<AlgebraBudget>(kProductsOfConditions);
  algebra_ = std::make_unique<Algebra>(q_.graph, no_values_, Algebra::Form::kFull, *budget_);
  algebra_->keep_whole(poses_as_variables(q_));
}

/// Returns nullptr if the algebra does not reach so far.
const Polynomial* Definedness::polynomial(NodeId node) {
  if (too_large_.contains(node)) return nullptr;
  try {
    return &algebra_->of(node);
  } catch (const TooLarge&) {
    too_large_.insert(node);
    return nullptr;
  }
}

std::string Definedness::key(const char* kind, NodeId operand, bool any_sign) {
  const Polynomial* p = polynomial(operand);
  if (p == nullptr) return kind + ("node " + std::to_string(operand));
  return kind + (p->is_zero() ? "0" : normalized(*p, any_sign).key());
}

/// The same for x and −x.
std::string Definedness::even_key(const char* kind, NodeId operand) {
  const Polynomial* p = polynomial(operand);
  if (p == nullptr) return kind + ("node " + std::to_string(operand));
  return kind + std::min(p->key(), p->scaled(Rational(-1)).key());
}

/// A power, a root or a product is not 0 exactly if its operands are not; a divisor has a condition of
/// its own.
void Definedness::add_factors(NodeId operand, Keys& keys) {
  const Node node = q_.graph.nodes()[std::size_t(operand)];
  const bool is_of_operands = node.op == Op::kPower || node.op == Op::kSqrt ||
                              node.op == Op::kAbs || node.op == Op::kNegate ||
                              node.op == Op::kMultiply || node.op == Op::kDivide;
  if (is_of_operands) {
    add_factors(node.a, keys);
    if (node.op == Op::kMultiply) add_factors(node.b, keys);
  } else if (form_.is_nonzero(operand)) {
    return;
  } else if (const Polynomial* p = polynomial(operand)) {
    add_factors(*p, keys);
  } else {
    keys.insert("nonzero node " + std::to_string(operand));
  }
}

void Definedness::add_factors(const Polynomial& p, Keys& keys) {
  if (p.is_zero() || p.terms().size() > 1) {
    keys.insert("nonzero " + (p.is_zero() ? "0" : normalized(p, true).key()));
    return;
  }
  for (const auto& [number, exponent] : p.terms().begin()->first) {
    const Atom atom = algebra_->atom(number);
    const bool is_of_argument =
        atom.kind == Atom::Kind::kPower ||
        (atom.kind == Atom::Kind::kFunction && (atom.op == Op::kSqrt || atom.op == Op::kAbs));
    const bool is_certain = atom.kind == Atom::Kind::kPi || exponent < 0 ||
                            (atom.kind == Atom::Kind::kFunction && atom.op == Op::kExp);
    if (is_of_argument)
      add_factors(atom.argument, keys);
    else if (!is_certain)
      keys.insert("nonzero " + Polynomial::atom(number).key());
  }
}

Definedness::Keys Definedness::keys_of(const Need& need) {
  Keys keys;
  switch (need.kind) {
    case Kind::kPositive:
      add_factors(need.operand, keys);
      if (!is_certain({Kind::kNonnegative, need.operand}))
        keys.merge(keys_of({Kind::kNonnegative, need.operand}));
      break;
    case Kind::kNonzero:
      add_factors(need.operand, keys);
      break;
    case Kind::kNonnegative:
      if (const Polynomial* p = polynomial(need.operand);
          p == nullptr || !p->is_constant() || p->constant().sign() < 0)
        keys.insert(key("nonnegative ", need.operand, false));
      break;
    case Kind::kWithinOne:
      keys.insert(even_key("within one ", need.operand));
      break;
    case Kind::kNoPole:
      keys.insert(even_key("no pole ", need.operand));
      break;
    case Kind::kOffCut:
      keys.insert(key("cut ", need.operand, false) + key(" and ", need.second, false));
      break;
  }
  return keys;
}

void Definedness::find_keys_of(const std::vector<Need>& needs, Keys& keys) {
  for (const Need& need : needs) keys.merge(keys_of(need));
}

void Definedness::add_certain_keys(Keys& keys) {
  for (const NodeId root : roots_)
    for (const Need& need : all_needs_of(root)) {
      if (need.kind == Kind::kNonnegative) keys.insert(key("nonnegative ", need.operand, false));
      const Polynomial* p = polynomial(need.operand);
      if (p != nullptr && (need.kind == Kind::kNonzero || need.kind == Kind::kPositive))
        add_factors(*p, keys);
    }
}

std::vector<std::string> Definedness::missing() {
  begin_algebra();
  Keys claimed, wanted;
  for (const auto& needs : claims_) find_keys_of(needs, claimed);
  std::set<std::string> sentences;
  for (const Named& place : wanted_)
    for (const Need& need : place.needs) {
      const Keys keys = keys_of(need);
      if (!std::includes(claimed.begin(), claimed.end(), keys.begin(), keys.end()))
        sentences.insert(place.name + " has " + words_of_need(need.kind) +
                         ", and the certificate has no line 'defined' or 'motion-defined' for it");
      wanted.insert(keys.begin(), keys.end());
    }
  bool has_certain_keys = false;
  for (const Named& line : lines_) {
    Keys keys;
    find_keys_of(line.needs, keys);
    const auto follows = [&] {
      return std::includes(wanted.begin(), wanted.end(), keys.begin(), keys.end());
    };
    if (!follows() && !has_certain_keys) {
      add_certain_keys(wanted);
      has_certain_keys = true;
    }
    if (!follows()) sentences.insert(line.name + " follows from no expression of the file");
  }
  return {sentences.begin(), sentences.end()};
}

}  // namespace regulus::verifier
