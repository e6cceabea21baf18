// SPDX-License-Identifier: Apache-2.0
// Sums of products of atoms with rational factors. An atom is just a number here; `algebra.hpp`
// defines what it stands for, and which relations hold.
#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "runtime/verifier/rational.hpp"

namespace regulus::verifier {

/// Exact algebra would need more terms, digits or time than allowed. Says nothing of the claim.
class TooLarge : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The work that exact algebra may do. Each product of two terms counts. Throws TooLarge.
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
  /// Returns true if there are no atoms.
  [[nodiscard]] bool is_constant() const noexcept {
    return terms_.empty() || (terms_.size() == 1 && terms_.begin()->first.empty());
  }
  /// Requires  is_constant().
  [[nodiscard]] Rational constant() const {
    return terms_.empty() ? Rational() : terms_.begin()->second;
  }

  /// Throws TooLarge.
  void add(const PowerProduct& product, const Rational& factor);
  void add(const Polynomial& other);
  [[nodiscard]] Polynomial scaled(const Rational& factor) const;

  /// Returns a text; two polynomials have the same text only if they are equal.
  [[nodiscard]] std::string key() const;

  friend bool operator==(const Polynomial& x, const Polynomial& y) { return x.terms_ == y.terms_; }

 private:
  Terms terms_;
};

/// Multiplies by the distributive law; relations between atoms are not applied. Throws TooLarge.
[[nodiscard]] Polynomial multiply(const Polynomial& x, const Polynomial& y, AlgebraBudget& budget);

}  // namespace regulus::verifier
