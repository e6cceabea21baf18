// SPDX-License-Identifier: Apache-2.0
// Rows of polynomials that are combinations of other rows with constant coefficients.
#pragma once

#include <map>
#include <vector>

#include "runtime/verifier/algebra.hpp"

namespace regulus::verifier {

using PolynomialRow = std::vector<Polynomial>;

/// Certain facts about numbers of exact algebra.
class ConstantSigns {
 public:
  ConstantSigns(Graph& graph, Algebra& algebra) : graph_(graph), algebra_(algebra) {}

  enum class Answer { kZero, kNonzero, kUnknown };
  /// Requires  algebra.is_constant(p).
  [[nodiscard]] Answer of(const Polynomial& p);

 private:
  Graph& graph_;
  Algebra& algebra_;
};

/// A polynomial by the products of the atoms that depend on variables: their factors are constant.
using ConstantFactors = std::map<PowerProduct, Polynomial>;
[[nodiscard]] ConstantFactors constant_factors(const Algebra& algebra, const Polynomial& p);

/// A set of rows that are independent over the constants.
class ConstantSpan {
 public:
  ConstantSpan(Graph& graph, Algebra& algebra) : algebra_(algebra), signs_(graph, algebra) {}

  enum class Answer { kDependent, kIndependent, kUnknown };
  /// Adds the row unless it is a combination of those that have been added, with coefficients that
  /// are the same at all values of all variables.
  [[nodiscard]] Answer add(const PolynomialRow& row);

 private:
  using Coefficients = std::map<std::pair<std::size_t, PowerProduct>, Polynomial>;
  struct Base {
    Coefficients row;
    std::pair<std::size_t, PowerProduct> pivot;  ///< its factor is certainly not 0
  };

  void eliminate(Coefficients& row, const Base& base);

  Algebra& algebra_;
  ConstantSigns signs_;
  std::vector<Base> bases_;
};

}  // namespace regulus::verifier
