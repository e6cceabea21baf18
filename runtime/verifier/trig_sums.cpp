// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/trig_sums.hpp"

#include "runtime/verifier/algebra.hpp"

namespace regulus::verifier {

TrigSum TrigSums::constant(NodeId coefficient) const { return {{none_, coefficient}}; }

void TrigSums::add(TrigSum& to, const std::vector<TrigFunction>& functions, NodeId coefficient) {
  if (a_.is_number(coefficient, 0)) return;
  const auto [at, is_new] = to.try_emplace(functions, coefficient);
  if (is_new) return;
  at->second = a_.sum(at->second, coefficient);
  if (a_.is_number(at->second, 0)) to.erase(at);
}

TrigSum TrigSums::sum(TrigSum x, const TrigSum& y, long factor) {
  for (const auto& [functions, coefficient] : y)
    add(x, functions,
        factor == -1 ? a_.negative(coefficient) : a_.product(a_.number(factor), coefficient));
  return x;
}

TrigSum TrigSums::scaled(NodeId factor, const TrigSum& x) {
  TrigSum result;
  for (const auto& [functions, coefficient] : x)
    add(result, functions, a_.product(factor, coefficient));
  return result;
}

TrigSum TrigSums::times_unknown(const TrigSum& x, std::size_t unknown) const {
  TrigSum result;
  for (const auto& [functions, coefficient] : x) {
    std::vector<TrigFunction> more = functions;
    ++more[unknown].power;
    result.emplace(std::move(more), coefficient);
  }
  return result;
}

/// Adds a term times cos(frequency·x), or sin. The term has no such factor of this unknown.
void TrigSums::add_wave(TrigSum& to, Term term, std::size_t unknown, bool is_sine,
                        NodeId frequency) {
  Graph& graph = a_.graph();
  if (const auto value = exact_value(graph, frequency)) {
    if (value->is_zero() && is_sine) return;
    if (value->sign() < 0 && is_sine) term.second = a_.negative(term.second);
    frequency = value->is_zero()    ? kNoNode
                : value->sign() < 0 ? graph.number(Rational(-1) * *value)
                                    : graph.number(*value);
  }
  TrigFunction& f = term.first[unknown];
  f.frequency = frequency;
  f.is_sine = is_sine && frequency != kNoNode;
  add(to, term.first, term.second);
}

/// By the sums for products of two sines or cosines.
TrigSum TrigSums::times(const TrigSum& x, std::size_t unknown, bool by_sine, NodeId frequency) {
  TrigSum result;
  for (const auto& [functions, coefficient] : x) {
    const TrigFunction& f = functions[unknown];
    if (f.frequency == kNoNode) {
      add_wave(result, {functions, coefficient}, unknown, by_sine, frequency);
      continue;
    }
    const NodeId half = a_.quotient(coefficient, a_.number(2)),
                 plus = a_.sum(f.frequency, frequency),
                 minus = a_.difference(f.frequency, frequency);
    const bool is_sine = f.is_sine != by_sine;
    // cos·cos = ½cos(−) + ½cos(+), sin·sin = ½cos(−) − ½cos(+),
    // sin·cos = ½sin(+) + ½sin(−), cos·sin = ½sin(+) − ½sin(−).
    const bool negates_plus = f.is_sine && by_sine, negates_minus = !f.is_sine && by_sine;
    add_wave(result, {functions, negates_plus ? a_.negative(half) : half}, unknown, is_sine, plus);
    add_wave(result, {functions, negates_minus ? a_.negative(half) : half}, unknown, is_sine,
             minus);
  }
  return result;
}

TrigVector TrigSums::times(const TrigVector& x, std::size_t unknown, bool by_sine,
                           NodeId frequency) {
  return {times(x[0], unknown, by_sine, frequency), times(x[1], unknown, by_sine, frequency),
          times(x[2], unknown, by_sine, frequency)};
}

TrigVector TrigSums::constant(const VectorNodes& v) const {
  TrigVector result;
  for (std::size_t i = 0; i < 3; ++i)
    if (!a_.is_number(v[i], 0)) result[i] = constant(v[i]);
  return result;
}

TrigVector TrigSums::sum(TrigVector x, const TrigVector& y, long factor) {
  for (std::size_t i = 0; i < 3; ++i) x[i] = sum(std::move(x[i]), y[i], factor);
  return x;
}

TrigVector TrigSums::scaled(NodeId factor, const TrigVector& x) {
  return {scaled(factor, x[0]), scaled(factor, x[1]), scaled(factor, x[2])};
}

TrigVector TrigSums::times_unknown(const TrigVector& x, std::size_t unknown) const {
  return {times_unknown(x[0], unknown), times_unknown(x[1], unknown), times_unknown(x[2], unknown)};
}

TrigVector TrigSums::product(const MatrixNodes& R, const TrigVector& x) {
  return {dot(R[0], x), dot(R[1], x), dot(R[2], x)};
}

TrigSum TrigSums::dot(const VectorNodes& u, const TrigVector& x) {
  return sum(sum(scaled(u[0], x[0]), scaled(u[1], x[1])), scaled(u[2], x[2]));
}

TrigVector TrigSums::cross(const VectorNodes& u, const TrigVector& x) {
  TrigVector result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    result[i] = sum(scaled(u[j], x[k]), scaled(u[k], x[j]), -1);
  }
  return result;
}

/// v becomes u(u·v) + (v − u(u·v))·cos ± (u × v)·sin.
TrigVector TrigSums::turned(const TrigVector& x, const VectorNodes& axis, std::size_t unknown,
                            NodeId frequency, long sign) {
  const TrigSum part = dot(axis, x);
  const TrigVector along = {scaled(axis[0], part), scaled(axis[1], part), scaled(axis[2], part)};
  return sum(sum(along, times(sum(x, along, -1), unknown, false, frequency)),
             times(cross(axis, x), unknown, true, frequency), sign);
}

NodeId TrigSums::function(const TrigFunction& f, NodeId unknown) {
  NodeId result = a_.number(1);
  for (int i = 0; i < f.power; ++i) result = a_.product(result, unknown);
  if (f.frequency == kNoNode) return result;
  const NodeId angle = a_.product(f.frequency, unknown);
  return a_.product(result, f.is_sine ? a_.sine(angle) : a_.cosine(angle));
}

NodeId TrigSums::expression(const TrigSum& x, const std::vector<NodeId>& unknowns) {
  return expression({x.begin(), x.end()}, 0, unknowns);
}

/// The terms have the same functions of the unknowns before `from`.
NodeId TrigSums::expression(std::vector<Term> terms, std::size_t from,
                            const std::vector<NodeId>& unknowns) {
  if (terms.empty()) return a_.number(0);
  if (from == unknowns.size()) return terms.front().second;
  std::map<TrigFunction, std::vector<Term>> groups;
  for (Term& term : terms) groups[term.first[from]].push_back(std::move(term));
  NodeId result = a_.number(0);
  for (auto& [f, group] : groups)
    result = a_.sum(result, a_.product(function(f, unknowns[from]),
                                       expression(std::move(group), from + 1, unknowns)));
  return result;
}

}  // namespace regulus::verifier
