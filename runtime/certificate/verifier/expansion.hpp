// SPDX-License-Identifier: Apache-2.0
// The matrix as a sum of monomials: A = Σ_μ C_μ·μ. A product K·A then adds up, for each monomial,
// what the rows of A contribute to it, so that what cancels between rows does cancel in intervals.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "runtime/certificate/verifier/evaluation.hpp"
#include "runtime/certificate/verifier/expression.hpp"

namespace regulus::verifier {

/// One entry of C_μ: the node of a coefficient.
struct Coefficient {
  std::size_t entry;  ///< of the matrix, row-major
  NodeId node;
};

struct Term {
  NodeId monomial;
  std::vector<Coefficient> coefficients;
};

/// Multiplies out the products in `matrix`. Coefficients are what does not depend on `variables`;
/// monomials are products of those variables, and of operations that are not multiplied out. New
/// nodes are added to the graph; their values are those of the expressions they come from.
[[nodiscard]] std::vector<Term> expand(Graph& graph, const std::vector<NodeId>& matrix,
                                       const std::vector<std::size_t>& variables,
                                       std::size_t variable_count);

}  // namespace regulus::verifier
