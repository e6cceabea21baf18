// SPDX-License-Identifier: GPL-3.0-or-later
// Sparse polynomials over the atoms of an AtomTable with exact rational coefficients.
#pragma once

#include <cln/rational.h>

#include <optional>
#include <vector>

#include "codegen/kernel/symbolic/atoms.hpp"

namespace regulus::detail {

struct Monomial {
  AtomProduct variables;
  AtomProduct coefficients;  ///< entries of K, pi, …

  friend bool operator==(const Monomial&, const Monomial&) = default;
};

[[nodiscard]] bool lex_greater(const Monomial& a, const Monomial& b) noexcept;

struct PolynomialTerm {
  Monomial monomial;
  cln::cl_RA factor;
};

/// Terms by decreasing monomial, no two alike, no factor 0. The terms with the same product of
/// variable atoms are adjacent: they form its coefficient.
class Polynomial {
 public:
  Polynomial() = default;
  explicit Polynomial(const cln::cl_RA& constant);
  /// Orders the terms and combines like ones.
  explicit Polynomial(std::vector<PolynomialTerm> terms);

  [[nodiscard]] const std::vector<PolynomialTerm>& terms() const noexcept { return terms_; }
  [[nodiscard]] bool is_zero() const noexcept { return terms_.empty(); }
  [[nodiscard]] bool has_variables() const noexcept;

 private:
  std::vector<PolynomialTerm> terms_;
};

[[nodiscard]] Polynomial operator+(const Polynomial& a, const Polynomial& b);
[[nodiscard]] Polynomial operator*(const Polynomial& a, const Polynomial& b);
[[nodiscard]] Polynomial operator*(const Polynomial& a, const cln::cl_RA& factor);
[[nodiscard]] bool operator==(const Polynomial& a, const Polynomial& b);

/// Returns the q with a = q·b; none if b does not divide a.
/// Requires  b ≠ 0.
[[nodiscard]] std::optional<Polynomial> divide_exactly(const Polynomial& a, const Polynomial& b);

/// A variable monomial with its coefficient: terms [first, last) of a polynomial.
struct Group {
  std::size_t first = 0;
  std::size_t last = 0;
};
[[nodiscard]] std::vector<Group> groups(const Polynomial& p);

/// Writes expressions as polynomials.
class Expander {
 public:
  /// Expansions with more terms than `most_terms` are given up. `squares_roots`: √c·√c of a
  /// rational c is c, so that the coordinates of a unit vector meet in like terms.
  explicit Expander(AtomTable& atoms, std::size_t most_terms = 20000, bool squares_roots = false)
      : atoms_(&atoms), most_terms_(most_terms), squares_roots_(squares_roots) {}

  /// Returns the same function, multiplied out; none if it has too many terms.
  [[nodiscard]] std::optional<Polynomial> expand(const Expression& e);

  /// Returns the expression as one indeterminate.
  [[nodiscard]] Polynomial atom(const Expression& e);

 private:
  std::optional<Polynomial> expanded(const Expression& e);
  std::optional<Polynomial> expand_sum(const Expressions& terms);
  std::optional<Polynomial> expand_product(const Expressions& factors);
  std::optional<Polynomial> expand_power(const Expression& e);
  [[nodiscard]] std::optional<Polynomial> bounded_product(const Polynomial& a,
                                                          const Polynomial& b) const;
  [[nodiscard]] Polynomial with_squared_roots(const Polynomial& p) const;

  AtomTable* atoms_;
  std::size_t most_terms_;
  bool squares_roots_;
  std::unordered_map<Expression, std::optional<Polynomial>, ExpressionHash> known_;
};

}  // namespace regulus::detail
