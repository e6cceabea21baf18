// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/exact_point.hpp"

#include "runtime/verifier/exact_rank.hpp"
#include "runtime/verifier/univariate.hpp"

namespace regulus::verifier {
namespace {

constexpr std::uint64_t kProductsOfPoint = 1 << 20;
constexpr std::uint64_t kProductsOfConstraint = 1 << 16;

std::vector<NodeId> coordinates(Question& q, const ClaimedPoint& point) {
  std::vector<NodeId> result = point.values;
  for (std::size_t k = 0; k < result.size(); ++k)
    if (result[k] == kNoNode && is_thin(point.box[k]))
      result[k] = q.graph.number(rational_of(point.box[k].lo));
  return result;
}

}  // namespace

ExactPoint::ExactPoint(Question& question, const ClaimedPoint& point)
    : q_(question),
      values_(coordinates(question, point)),
      budget_(kProductsOfPoint),
      algebra_(question.graph, values_, Algebra::Form::kFull, budget_) {}

bool ExactPoint::is_singular() {
  try {
    algebra_.find_units(q_.matrix);
    Polynomial p = algebra_.determinant(q_.matrix, q_.columns);
    if (algebra_.vanishes(p)) return true;
    if (!q_.has_threshold) return false;
    for (const NodeId scale : q_.scale) p = algebra_.product(p, algebra_.of(scale));
    const Polynomial& alpha = algebra_.of(q_.alpha);
    if (!p.is_constant() || !alpha.is_constant()) return false;
    Rational size;
    fmpq_abs(size.get(), p.constant().get());
    return (size - alpha.constant()).sign() <= 0;
  } catch (const TooLarge&) {
    return false;
  }
}

/// det AᵀA is the sum of the squares of all minors of as many rows as A has columns.
bool ExactPoint::has_lost_rank() {
  try {
    const std::vector<NodeId> gram = gram_matrix(q_);
    algebra_.find_units(gram);
    return algebra_.vanishes(algebra_.determinant(gram, q_.columns));
  } catch (const TooLarge&) {
    return false;
  }
}

bool ExactPoint::is_nonpositive(NodeId expression) {
  try {
    const Polynomial& p = algebra_.of(expression);
    return p.is_constant() ? p.constant().sign() <= 0 : algebra_.vanishes(p);
  } catch (const TooLarge&) {
    return false;
  }
}

/// Along the segment, the expression must become a polynomial in one variable t of [0, 1].
bool is_nonpositive_between(Question& q, const Box& from, const Box& to, NodeId expression) {
  std::vector<NodeId> values(from.size(), kNoNode);
  const int number = int(from.size());  // after the variables of the question
  const NodeId t = q.graph.add(Op::kVariable, number);
  for (std::size_t k = 0; k < from.size(); ++k) {
    if (!is_thin(from[k]) || !is_thin(to[k])) continue;
    const Rational start = rational_of(from[k].lo);
    const NodeId way = q.graph.number(rational_of(to[k].lo) - start);
    values[k] = q.graph.add(Op::kAdd, q.graph.number(start), q.graph.add(Op::kMultiply, way, t));
  }
  AlgebraBudget budget(kProductsOfConstraint);
  Algebra algebra(q.graph, values, Algebra::Form::kFull, budget);
  try {
    const Polynomial& p = algebra.of(expression);
    int atom = 0;
    for (const auto& [powers, factor] : p.terms())
      if (!powers.empty()) atom = powers.front().first;
    if (!p.is_constant() &&
        (algebra.atom(atom).kind != Atom::Kind::kVariable || algebra.atom(atom).number != number))
      return false;
    Univariate along;
    return along.set(p, atom) && along.is_nonpositive_on_unit();
  } catch (const TooLarge&) {
    return false;
  }
}

}  // namespace regulus::verifier
