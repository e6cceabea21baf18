// SPDX-License-Identifier: Apache-2.0
// Ranges of expressions in rational numbers, where doubles round a bound past the end of a domain:
// √(x − 1/3) for x ≥ 1/3, asin(3x) for x ≤ 1/3, √(1 − cos x).
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "runtime/certificate/verifier/expression.hpp"
#include "runtime/certificate/verifier/interval.hpp"

namespace regulus::verifier {

/// The ends of the range of a variable that are known to be rational numbers.
struct RationalEnds {
  std::optional<Rational> lo, hi;
};

struct RationalRange {
  Rational lo, hi;
};

/// Sums, products, quotients, powers and magnitudes are exact; functions of one argument are
/// enclosed in doubles over the exact range of it, other operations taken as doubles enclose them.
class ExactRanges {
 public:
  /// `ends`: by variable; empty: none is known. `values`: enclosures of what the nodes that are
  /// asked about are made of, by node. All must outlive this object.
  ExactRanges(const Graph& graph, const std::vector<RationalEnds>& ends,
              const std::vector<Interval>& box, const std::vector<Interval>& values)
      : graph_(graph), ends_(ends), box_(box), values_(values) {}

  /// Encloses a node at the points of the box that are within the ranges of the variables; not
  /// bounded where there is no such point.
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
