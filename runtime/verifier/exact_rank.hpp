// SPDX-License-Identifier: Apache-2.0
// Shows full column rank of a matrix with more rows than columns, by determinants that are
// multiplied out exactly. See PROOF.md, "The exact determinant".
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "runtime/verifier/exact_determinant.hpp"

namespace regulus::verifier {

/// Returns AᵀA, row-major, in new nodes of the question's graph.
[[nodiscard]] std::vector<NodeId> gram_matrix(Question& question);

class ExactRank {
 public:
  /// Adds to the question's graph. Requires more rows than columns.
  ExactRank(Question& question, const Variety& variety, long max_bits)
      : q_(question), variety_(variety), max_bits_(max_bits) {}

  /// `middle`: any point; it determines which rows are used.
  ///
  /// Ensures   true only if A has full column rank at every point of the set in the box.
  /// Requires  the matrix is defined all over the box.
  [[nodiscard]] bool is_full(const Box& box, const Box& middle);

 private:
  using Rows = std::vector<std::size_t>;
  [[nodiscard]] ExactDeterminant* minor_at(const Box& middle);
  [[nodiscard]] ExactDeterminant& gram();

  Question& q_;
  const Variety& variety_;
  const long max_bits_;
  std::map<Rows, ExactDeterminant> minors_;
  std::optional<ExactDeterminant> gram_;
};

}  // namespace regulus::verifier
