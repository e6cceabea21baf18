// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/equality.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "runtime/verifier/algebra.hpp"
#include "runtime/verifier/evaluation.hpp"

namespace regulus::verifier {
namespace {

constexpr std::uint64_t kProductsOfPair = 1 << 18;  ///< for one pair
constexpr long kBitsAtPoint = 2048;                 ///< of values at points
constexpr int kPoints = 4;
constexpr long kLargestRoot = 1000;  ///< the algebra takes all primes below out of other roots
constexpr std::array kForms{Algebra::Form::kPlain, Algebra::Form::kFull};

/// The atoms of polynomials of which only the empty sum is 0: variables, pi, roots of primes, and sine
/// and cosine of one multiple of a variable. (e^{iax} is transcendental over the functions x; pi over
/// the roots; roots of different primes are linearly independent, and so are their products.)
class IndependentAtoms {
 public:
  explicit IndependentAtoms(const Algebra& algebra) : algebra_(algebra) {}

  bool has_all_of(const Polynomial& p) {
    return std::all_of(p.terms().begin(), p.terms().end(), [this](const auto& term) {
      return std::all_of(term.first.begin(), term.first.end(), [this](const auto& factor) {
        return factor.second > 0 && has(algebra_.atom(factor.first));
      });
    });
  }

 private:
  bool has(const Atom& atom) {
    if (atom.kind == Atom::Kind::kVariable || atom.kind == Atom::Kind::kPi) return true;
    if (atom.kind != Atom::Kind::kFunction) return false;
    if (atom.op == Op::kSqrt)
      return atom.argument.is_constant() && atom.argument.constant().sign() > 0 &&
             (Rational(kLargestRoot) - atom.argument.constant()).sign() > 0;
    return (atom.op == Op::kSin || atom.op == Op::kCos) && is_angle(atom.argument);
  }

  /// A rational number times a variable, or times a variable and pi; of each variable only one.
  bool is_angle(const Polynomial& argument) {
    if (argument.terms().size() != 1) return false;
    int variable = -1;
    for (const auto& [number, exponent] : argument.terms().begin()->first) {
      const Atom& atom = algebra_.atom(number);
      if (exponent != 1 || (atom.kind != Atom::Kind::kPi && variable >= 0)) return false;
      if (atom.kind == Atom::Kind::kVariable)
        variable = atom.number;
      else if (atom.kind != Atom::Kind::kPi)
        return false;
    }
    return variable >= 0 &&
           angles_.emplace(variable, argument.key()).first->second == argument.key();
  }

  const Algebra& algebra_;
  std::map<int, std::string> angles_;  ///< by variable
};

Equality by_algebra(Question& q, NodeId difference, Algebra::Form form,
                    const std::vector<NodeId>& whole) {
  AlgebraBudget budget(kProductsOfPair);
  const std::vector<NodeId> none;
  try {
    Algebra algebra(q.graph, none, form, budget);
    algebra.keep_whole(whole);
    if (form == Algebra::Form::kFull) algebra.find_units({difference});
    const Polynomial p = algebra.cleared(algebra.split_functions(algebra.of(difference)));
    if (p.is_zero()) return Equality::kEqual;
    if (form == Algebra::Form::kPlain || !whole.empty()) return Equality::kUnknown;
    return IndependentAtoms(algebra).has_all_of(p) ? Equality::kDifferent : Equality::kUnknown;
  } catch (const TooLarge&) {
    return Equality::kUnknown;
  }
}

/// Returns the next of a sequence of numbers without a pattern (SplitMix64).
std::uint64_t next_number(std::uint64_t& state) {
  std::uint64_t z = state += 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

/// Returns some point of the ranges.
std::vector<Ball> random_point(const Question& q, std::uint64_t& state) {
  std::vector<Ball> result(q.variables.size());
  for (std::size_t k = 0; k < result.size(); ++k) {
    const Variable& v = q.variables[k];
    const ulong part = next_number(state) >> 32;
    const auto ends = evaluate(q.graph, {v.lo, v.hi}, {}, kBitsAtPoint);
    if (!ends) continue;
    Ball& x = result[k];
    arb_sub(x.get(), (*ends)[1].get(), (*ends)[0].get(), kBitsAtPoint);
    arb_mul_ui(x.get(), x.get(), part, kBitsAtPoint);
    arb_mul_2exp_si(x.get(), x.get(), -32);
    arb_add(x.get(), x.get(), (*ends)[0].get(), kBitsAtPoint);
    arb_get_mid_arb(x.get(), x.get());
  }
  return result;
}

bool certain_nonzero_somewhere(const Question& q, NodeId difference) {
  std::uint64_t state = 0;
  for (int k = 0; k < kPoints; ++k) {
    const auto value = evaluate(q.graph, {difference}, random_point(q, state), kBitsAtPoint);
    if (value && arb_contains_zero((*value)[0].get()) == 0) return true;
  }
  return false;
}

/// Returns p/|first factor|.
Polynomial without_content(const Polynomial& p) {
  Rational size;
  fmpq_abs(size.get(), p.terms().begin()->second.get());
  return p.scaled(Rational(1) / size);
}

}  // namespace

Equality equality(Question& q, NodeId a, NodeId b) {
  if (a == b) return Equality::kEqual;
  const NodeId difference = q.graph.add(Op::kSubtract, a, b);
  const std::vector<NodeId> whole = poses_as_variables(q);
  for (const Algebra::Form form : kForms)
    if (!whole.empty() && by_algebra(q, difference, form, whole) == Equality::kEqual)
      return Equality::kEqual;
  for (const Algebra::Form form : kForms)
    if (const Equality result = by_algebra(q, difference, form, {}); result != Equality::kUnknown)
      return result;
  return certain_nonzero_somewhere(q, difference) ? Equality::kDifferent : Equality::kUnknown;
}

std::vector<NodeId> poses_as_variables(const Question& q) {
  std::set<NodeId> poses;
  for (auto at = q.stated.lower_bound("pose ");
       at != q.stated.end() && at->first.starts_with("pose "); ++at)
    for (const Scope* scope : {&q.actual, &q.commanded})
      if (const auto found = scope->find(at->first.substr(5)); found != scope->end())
        poses.insert(found->second);
  std::vector<NodeId> result;
  for (const NodeId pose : poses)
    if (const Op op = q.graph.nodes()[std::size_t(pose)].op;
        op != Op::kVariable && op != Op::kConstant)
      result.push_back(pose);
  return result;
}

bool certain_proportional(Question& q, NodeId a, NodeId b) {
  if (a == b) return true;
  const std::vector<NodeId> none, whole = poses_as_variables(q);
  for (const Algebra::Form form : kForms) try {
      AlgebraBudget budget(kProductsOfPair);
      Algebra algebra(q.graph, none, form, budget);
      algebra.keep_whole(whole);
      if (form == Algebra::Form::kFull) algebra.find_units({q.graph.add(Op::kSubtract, a, b)});
      const Polynomial first = algebra.of(a), second = algebra.of(b);
      if (first.is_zero() || second.is_zero()) return first.is_zero() && second.is_zero();
      Polynomial difference = without_content(first);
      difference.add(without_content(second).scaled(Rational(-1)));
      if (algebra.vanishes(difference)) return true;
    } catch (const TooLarge&) {
      continue;
    }
  return false;
}

}  // namespace regulus::verifier
