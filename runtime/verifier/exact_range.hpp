// SPDX-License-Identifier: Apache-2.0
// Ranges of expressions in rational numbers, for bounds that doubles would round past the end of a
// domain: √(x − 1/3) for x ≥ 1/3, asin(3x) for x ≤ 1/3, √(1 − cos x).
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "runtime/verifier/expression.hpp"
#include "runtime/verifier/interval.hpp"

namespace regulus::verifier {

/// The ends of the range of a variable; an end has a value if it is known to be rational.
struct RationalEnds {
  std::optional<Rational> lo, hi;
};

struct RationalRange {
  Rational lo, hi;
};

/// Sums, products, quotients, powers and magnitudes are exact. Functions of one argument are
/// enclosed in doubles over its exact range. Other operations use their enclosures in doubles.
class ExactRanges {
 public:
  /// `ends`: by variable; an empty list means that no end is known. `values`: by node, enclosures
  /// of the nodes that the requested nodes are made of. All must outlive this object.
  ExactRanges(const Graph& graph, const std::vector<RationalEnds>& ends,
              const std::vector<Interval>& box, const std::vector<Interval>& values)
      : graph_(graph), ends_(ends), box_(box), values_(values) {}

  /// Encloses a node at the points of the box that are within the ranges of the variables. The
  /// result is not bounded if there is no such point.
  [[nodiscard]] Interval of(NodeId node);

 private:
  [[nodiscard]] RationalRange range(NodeId id);
  [[nodiscard]] std::optional<RationalRange> exact(const Node& node);
  [[nodiscard]] std::optional<RationalRange> function(const Node& node);
  [[nodiscard]] RationalRange variable(std::size_t k);

  const Graph& graph_;
  const std::vector<RationalEnds>& ends_;
  const std::vector<Interval>& box_;
  const std::vector<Interval>& values_;
  std::map<NodeId, RationalRange> known_;
  bool is_empty_ = false;  ///< no point of the box is within the ranges
};

}  // namespace regulus::verifier
