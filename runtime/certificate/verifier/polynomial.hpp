// SPDX-License-Identifier: Apache-2.0
// Sums of products of atoms with rational factors. An atom is a number from outside: what it stands
// for, and which relations hold, is for `algebra.hpp`.
#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "runtime/certificate/verifier/rational.hpp"

namespace regulus::verifier {

/// Exact algebra takes more terms, digits or time than it may. Says nothing about the claim.
class TooLarge : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The work that exact algebra may do. Every product of two terms counts; throws TooLarge.
class AlgebraBudget {
 public:
  explicit AlgebraBudget(std::uint64_t products) : left_(products) {}
  void spend(std::uint64_t products) {
    if (products > left_) throw TooLarge("exact algebra takes too many products of terms");
    left_ -= products;
  }

 private:
  std::uint64_t left_;
};

inline constexpr std::size_t kMostTermsOfPolynomial = 1 << 16;
inline constexpr int kMostDegree = 256;  ///< of a product, signs aside
inline constexpr std::size_t kMostBitsOfFactor = 1 << 16;

/// Atoms with exponents other than 0, in the order of the atoms.
using PowerProduct = std::vector<std::pair<int, int>>;

[[nodiscard]] PowerProduct multiply(const PowerProduct& x, const PowerProduct& y);

class Polynomial {
 public:
  using Terms = std::map<PowerProduct, Rational>;

  Polynomial() = default;
  explicit Polynomial(const Rational& constant) { add({}, constant); }
  explicit Polynomial(long constant) : Polynomial(Rational(constant)) {}
  static Polynomial atom(int number, int exponent = 1) {
    Polynomial result;
    result.add({{number, exponent}}, Rational(1));
    return result;
  }

  [[nodiscard]] const Terms& terms() const noexcept { return terms_; }
  [[nodiscard]] bool is_zero() const noexcept { return terms_.empty(); }
  /// Has no atoms.
  [[nodiscard]] bool is_constant() const noexcept {
    return terms_.empty() || (terms_.size() == 1 && terms_.begin()->first.empty());
  }
  /// Of a constant.
  [[nodiscard]] Rational constant() const {
    return terms_.empty() ? Rational() : terms_.begin()->second;
  }

  /// Throws TooLarge.
  void add(const PowerProduct& product, const Rational& factor);
  void add(const Polynomial& other);
  [[nodiscard]] Polynomial scaled(const Rational& factor) const;

  /// A text that equal polynomials, and no others, have in common.
  [[nodiscard]] std::string key() const;

  friend bool operator==(const Polynomial& x, const Polynomial& y) { return x.terms_ == y.terms_; }

 private:
  Terms terms_;
};

/// The product by the distributive law; relations between atoms are not applied. Throws TooLarge.
[[nodiscard]] Polynomial multiply(const Polynomial& x, const Polynomial& y, AlgebraBudget& budget);

}  // namespace regulus::verifier
