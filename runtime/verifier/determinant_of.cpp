// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/determinant_of.hpp"

#include <bit>

#include "runtime/verifier/algebra.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/short_terms.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kMostRows = 8;
constexpr std::uint64_t kMostProducts = 1 << 21;

/// minors[S] is that of the first |S| rows and the columns of S.
NodeId by_minors(Graph& graph, const std::vector<NodeId>& matrix, std::size_t n) {
  const ShortTerms terms(graph);
  std::vector<NodeId> minors(std::size_t{1} << n, terms.zero);
  minors[0] = terms.one;
  for (std::size_t set = 1; set < minors.size(); ++set) {
    const auto row = std::size_t(std::popcount(set)) - 1;
    bool is_added = row % 2 == 0;
    for (std::size_t j = 0; j < n; ++j) {
      if ((set >> j & 1) == 0) continue;
      const NodeId term = terms.product(matrix[row * n + j], minors[set & ~(std::size_t{1} << j)]);
      minors[set] = is_added ? terms.sum(minors[set], term) : terms.difference(minors[set], term);
      is_added = !is_added;
    }
  }
  return minors.back();
}

/// Terms that cancel make the enclosures of minors wider.
NodeId expanded(Question& question) try {
  const std::vector<NodeId> no_values;
  AlgebraBudget budget(kMostProducts);
  Algebra algebra(question.graph, no_values, Algebra::Form::kFull, budget);
  return algebra.nested_expression(algebra.determinant(question.matrix, question.rows));
} catch (const TooLarge&) {
  return by_minors(question.graph, question.matrix, question.rows);
}

}  // namespace

NodeId determinant_of(Question& question) {
  if (question.rows > kMostRows) throw Rejection("a bound of a determinant has at most 8 rows");
  NodeId result = expanded(question);
  for (const NodeId scale : question.scale)
    result = ShortTerms(question.graph).product(result, scale);
  return result;
}

}  // namespace regulus::verifier
