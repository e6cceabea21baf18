// SPDX-License-Identifier: Apache-2.0
// Exact algebra at a point of a witness, or along the segment between two points.
#pragma once

#include "runtime/verifier/algebra.hpp"
#include "runtime/verifier/variety.hpp"

namespace regulus::verifier {

/// A point of a witness. If a coordinate is the end of its range or an exact value, `values` has that
/// expression and the box encloses it. The other coordinates have kNoNode there.
struct ClaimedPoint {
  Box box;
  std::vector<NodeId> values;
};

class ExactPoint {
 public:
  /// A coordinate that is an interval, and has no expression, stays a variable. Nothing depends on a
  /// variable of one value.
  ExactPoint(Question& question, const ClaimedPoint& point);

  /// Ensures   true only if |det A·∏ scale| ≤ alpha at the point, where these are defined there.
  [[nodiscard]] bool is_singular();
  /// Ensures   true only if A has less than full column rank at the point, where it is defined there.
  [[nodiscard]] bool has_lost_rank();
  /// Ensures   true only if the expression is ≤ 0 at the point, where it is defined there.
  [[nodiscard]] bool is_nonpositive(NodeId expression);

 private:
  Question& q_;
  std::vector<NodeId> values_;
  AlgebraBudget budget_;
  Algebra algebra_;
};

/// Ensures   true only if the expression is ≤ 0 all along the segment, wherever it is defined.
[[nodiscard]] bool is_nonpositive_between(Question& question, const Box& from, const Box& to,
                                          NodeId expression);

}  // namespace regulus::verifier
