// SPDX-License-Identifier: Apache-2.0
// The matrix as a sum of monomials: A = Σ_μ C_μ·μ. For each monomial, a product K·A then adds the
// contributions of all rows of A, so terms that cancel between rows cancel in intervals too.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/expression.hpp"

namespace regulus::verifier {

/// The node of a coefficient that belongs to one entry of C_μ.
struct Coefficient {
  std::size_t entry;  ///< of the matrix, row-major
  NodeId node;
};

struct Term {
  NodeId monomial;
  std::vector<Coefficient> coefficients;
};

/// Multiplies out the products in `matrix`. Coefficients do not depend on `variables`. Monomials
/// are products of those variables and of operations that are not multiplied out. Adds nodes to the
/// graph; their values are those of the expressions from which they are made.
[[nodiscard]] std::vector<Term> expand(Graph& graph, const std::vector<NodeId>& matrix,
                                       const std::vector<std::size_t>& variables,
                                       std::size_t variable_count);

}  // namespace regulus::verifier
