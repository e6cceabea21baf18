// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/polynomial.hpp"

#include <cstdlib>

namespace regulus::verifier {
namespace {

/// A product of numbers with more bits counts as several products.
constexpr std::size_t kBitsOfOneProduct = 64;

}  // namespace

PowerProduct multiply(const PowerProduct& x, const PowerProduct& y) {
  PowerProduct result;
  int degree = 0;
  auto a = x.begin(), b = y.begin();
  while (a != x.end() || b != y.end()) {
    std::pair<int, int> next;
    if (b == y.end() || (a != x.end() && a->first < b->first))
      next = *a++;
    else if (a == x.end() || b->first < a->first)
      next = *b++;
    else
      next = {a->first, (a++)->second + (b++)->second};
    if (next.second == 0) continue;
    degree += std::abs(next.second);
    result.push_back(next);
  }
  if (degree > kMostDegree) throw TooLarge("exact algebra takes too high a degree");
  return result;
}

void Polynomial::add(const PowerProduct& product, const Rational& factor) {
  if (factor.is_zero()) return;
  const auto [place, is_new] = terms_.try_emplace(product, factor);
  if (is_new) {
    if (terms_.size() > kMostTermsOfPolynomial)
      throw TooLarge("exact algebra takes too many terms");
  } else {
    fmpq_add(place->second.get(), place->second.get(), factor.get());
  }
  if (place->second.bits() > kMostBitsOfFactor)
    throw TooLarge("exact algebra takes too many digits");
  if (place->second.is_zero()) terms_.erase(place);
}

void Polynomial::add(const Polynomial& other) {
  for (const auto& [product, factor] : other.terms_) add(product, factor);
}

Polynomial Polynomial::scaled(const Rational& factor) const {
  Polynomial result;
  for (const auto& [product, own] : terms_) result.add(product, own * factor);
  return result;
}

std::string Polynomial::key() const {
  std::string result;
  for (const auto& [product, factor] : terms_) {
    result += '+';
    result += factor.text();
    for (const auto& [atom, exponent] : product) {
      result += '*';
      result += std::to_string(atom);
      result += '^';
      result += std::to_string(exponent);
    }
  }
  return result;
}

Polynomial multiply(const Polynomial& x, const Polynomial& y, AlgebraBudget& budget) {
  Polynomial result;
  for (const auto& [product1, factor1] : x.terms())
    for (const auto& [product2, factor2] : y.terms()) {
      budget.spend(1 + (factor1.bits() + factor2.bits()) / kBitsOfOneProduct);
      result.add(multiply(product1, product2), factor1 * factor2);
    }
  return result;
}

}  // namespace regulus::verifier
