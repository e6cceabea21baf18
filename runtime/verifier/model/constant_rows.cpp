// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/constant_rows.hpp"

#include "runtime/verifier/evaluation.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfRow = 1024;

}  // namespace

ConstantSigns::Answer ConstantSigns::of(const Polynomial& p) {
  if (p.is_constant()) return p.is_zero() ? Answer::kZero : Answer::kNonzero;
  if (algebra_.vanishes(p)) return Answer::kZero;
  const auto value = evaluate(graph_, {algebra_.expression(p)}, {}, kBitsOfRow);
  return value && arb_contains_zero((*value)[0].get()) == 0 ? Answer::kNonzero : Answer::kUnknown;
}

ConstantFactors constant_factors(const Algebra& algebra, const Polynomial& p) {
  ConstantFactors result;
  for (const auto& [powers, factor] : p.terms()) {
    PowerProduct varying, constant;
    for (const auto& power : powers)
      (algebra.is_constant({power}) ? constant : varying).push_back(power);
    result[varying].add(constant, factor);
  }
  return result;
}

ConstantSpan::Answer ConstantSpan::add(const PolynomialRow& row) {
  Coefficients rest;
  for (std::size_t column = 0; column < row.size(); ++column)
    for (auto& [powers, factor] : constant_factors(algebra_, row[column]))
      rest.emplace(std::pair(column, powers), factor);
  for (const Base& base : bases_) eliminate(rest, base);
  bool is_zero = true;
  for (const auto& [place, factor] : rest) {
    const auto answer = signs_.of(factor);
    if (answer == ConstantSigns::Answer::kNonzero) {
      const auto pivot = place;
      bases_.push_back({std::move(rest), pivot});
      return Answer::kIndependent;
    }
    is_zero = is_zero && answer == ConstantSigns::Answer::kZero;
  }
  return is_zero ? Answer::kDependent : Answer::kUnknown;
}

/// Without division: row·pivot − base·entry.
void ConstantSpan::eliminate(Coefficients& row, const Base& base) {
  const auto at = row.find(base.pivot);
  if (at == row.end()) return;
  const Polynomial entry = at->second, pivot = base.row.at(base.pivot);
  for (auto& [place, factor] : row) factor = algebra_.product(factor, pivot);
  for (const auto& [place, factor] : base.row)
    row[place].add(algebra_.product(factor, entry).scaled(Rational(-1)));
}

}  // namespace regulus::verifier
