// SPDX-License-Identifier: Apache-2.0
// Expressions as polynomials over the rationals in atoms. They are exact, so terms that cancel
// disappear. PROOF.md, "Exact algebra", has the relations.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/verifier/expression.hpp"
#include "runtime/verifier/polynomial.hpp"

namespace regulus::verifier {

/// An atom: a variable, pi, a function of polynomials, or a polynomial that is used as a divisor.
struct Atom {
  enum class Kind {
    kVariable,  ///< number
    kPi,
    kFunction,  ///< op of argument, and of second for kAtan2
    kPower,     ///< argument to the even power `number`, which is not multiplied out
    kDivisor,   ///< argument; occurs with negative exponents only
  } kind;
  Op op = Op::kPi;
  int number = 0;
  Polynomial argument, second;
  int sine = -1;  ///< for a cosine: the atom that is the sine of the same angle
};

class Algebra {
 public:
  enum class Form {
    kPlain,  ///< functions and even powers are atoms, identified by their arguments
    kFull,   ///< every relation of PROOF.md is applied
  };

  /// `values`: for a variable of one value the expression of it, for others kNoNode. An empty list:
  /// no variable has one value. All must outlive this object.
  Algebra(Graph& graph, const std::vector<NodeId>& values, Form form, AlgebraBudget& budget)
      : graph_(graph), values_(values), form_(form), budget_(budget) {}

  [[nodiscard]] Form form() const noexcept { return form_; }

  /// Takes these expressions for variables of their own: what is then equal is equal whatever they are.
  /// Call it before `of`, or not at all.
  void keep_whole(const std::vector<NodeId>& expressions) { whole_ = expressions; }

  /// Ensures   the result has the value of the expression wherever all its operations are defined.
  ///           Throws TooLarge, also for a division by an expression that is 0 identically.
  [[nodiscard]] const Polynomial& of(NodeId id);

  [[nodiscard]] Polynomial product(const Polynomial& x, const Polynomial& y);

  /// Returns p multiplied by each atom with a negative exponent as often as it occurs.
  ///
  /// Ensures   where the atoms have values and divisors are not 0, the result is 0 exactly where p is.
  [[nodiscard]] Polynomial cleared(Polynomial p);
  /// Ensures   true only if p is 0 wherever its atoms have values and its divisors are not 0.
  [[nodiscard]] bool vanishes(const Polynomial& p) { return cleared(p).is_zero(); }

  /// Returns p with √f·√g in place of √h, and log f + log g in place of log h, if h = f·g and all
  /// three have been met.
  ///
  /// Ensures   the result has the value of p wherever all functions that have been met are defined.
  [[nodiscard]] Polynomial split_functions(const Polynomial& p);

  /// Returns the determinant of a matrix of expressions, by minors.
  [[nodiscard]] Polynomial determinant(const std::vector<NodeId>& matrix, std::size_t order);

  /// Returns an expression of the graph with the value of a polynomial.
  [[nodiscard]] NodeId expression(const Polynomial& p);
  /// The same; the atom that most terms have is taken out of them, again and again.
  [[nodiscard]] NodeId nested_expression(const Polynomial& p);

  [[nodiscard]] const Atom& atom(int number) const { return atoms_[std::size_t(number)]; }

  /// Finds units of angles: each angle is a sum of whole multiples of units. Each product of atoms
  /// has one unit for all of `roots`. Call it before `of`, or not at all.
  void find_units(const std::vector<NodeId>& roots);

  /// Ensures   true only if no atom of p depends on a variable.
  [[nodiscard]] bool is_constant(const PowerProduct& powers) const;
  [[nodiscard]] bool is_constant(const Polynomial& p) const;

 private:
  [[nodiscard]] Polynomial compute(const Node& node);
  [[nodiscard]] Polynomial variable(int number);
  [[nodiscard]] Polynomial sum(const Polynomial& x, const Polynomial& y, long factor);
  [[nodiscard]] Polynomial power(const Polynomial& x, int exponent);
  [[nodiscard]] Polynomial inverse(const Polynomial& x);
  [[nodiscard]] Polynomial inverse_of(NodeId divisor);
  [[nodiscard]] Polynomial root(const Polynomial& x);
  [[nodiscard]] Polynomial root_of_rational(const Rational& x);
  [[nodiscard]] Polynomial root_of_integer(const fmpz_t x);
  [[nodiscard]] Polynomial magnitude(const Polynomial& x);
  [[nodiscard]] Polynomial exponential(const Polynomial& x);
  [[nodiscard]] Polynomial odd_function(Op op, const Polynomial& x);
  [[nodiscard]] Polynomial function(Op op, const Polynomial& x);
  [[nodiscard]] Polynomial angle_of_two(const Polynomial& y, const Polynomial& x);

  struct Turn {
    Polynomial sine, cosine;
  };
  [[nodiscard]] Turn turn(const Polynomial& angle);
  [[nodiscard]] Turn turn_of_pi(const Rational& factor);
  [[nodiscard]] Turn turn_of_part(const Rational& factor);
  [[nodiscard]] Turn turn_of_small_part(const Rational& factor);
  [[nodiscard]] Turn turn_of_unit(const Polynomial& unit);
  [[nodiscard]] Turn multiple(Turn unit, long times);
  [[nodiscard]] Turn add(const Turn& x, const Turn& y);
  [[nodiscard]] Polynomial pi();
  [[nodiscard]] bool is_pi(const PowerProduct& product) const;

  [[nodiscard]] int number_of(Atom atom, const std::string& key);
  [[nodiscard]] int atom_of(Op op, const Polynomial& argument, const Polynomial& second = {});
  [[nodiscard]] Polynomial reduced(const Polynomial& p);
  [[nodiscard]] std::optional<std::pair<int, int>> parts_of(int number);
  [[nodiscard]] bool reducible(const std::pair<int, int>& factor) const;
  [[nodiscard]] Polynomial replacement(const std::pair<int, int>& factor);
  [[nodiscard]] NodeId expression_of_atom(int number);

  Graph& graph_;
  const std::vector<NodeId>& values_;
  const Form form_;
  AlgebraBudget& budget_;
  std::vector<Atom> atoms_;
  std::map<std::string, int> numbers_;
  std::map<NodeId, Polynomial> known_;
  std::vector<NodeId> whole_;
  std::map<PowerProduct, Rational> units_;  ///< the denominators of the units of angles
  bool finding_ = false;
};

/// Returns the value of an expression without variables if it is found to be rational.
[[nodiscard]] std::optional<Rational> exact_value(Graph& graph, NodeId expression);

/// Ensures   true only if two expressions are the same node, or equal wherever both have values.
[[nodiscard]] bool certain_equal(Graph& graph, NodeId a, NodeId b, std::uint64_t products);

}  // namespace regulus::verifier
