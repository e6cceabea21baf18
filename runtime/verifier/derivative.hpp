// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "runtime/verifier/expression.hpp"

namespace regulus::verifier {

/// Adds derivatives by one variable to a graph.
///
/// Ensures   if all operations of the derivative are defined over a box, so are those of the
///           expression over its interior, and the mean value theorem bounds its differences. The
///           derivative of |a| is sign(a), which is any value of [−1, 1] where a may be 0.
class Differentiator {
 public:
  Differentiator(Graph& graph, std::size_t variable)
      : graph_(graph), variable_(int(variable)), one_(graph.number("1")) {}

  /// Returns kNoNode for a derivative that is 0 everywhere.
  [[nodiscard]] NodeId of(NodeId id);

 private:
  [[nodiscard]] NodeId differentiate(Node node, NodeId id);
  [[nodiscard]] NodeId slope(const Node& node, NodeId id);
  [[nodiscard]] NodeId product(NodeId a, NodeId b);
  [[nodiscard]] NodeId sum(NodeId a, NodeId b);
  [[nodiscard]] NodeId negative(NodeId a);
  [[nodiscard]] NodeId quotient(NodeId a, NodeId b);
  [[nodiscard]] NodeId power(NodeId a, int n) { return n == 1 ? a : graph_.add(Op::kPower, a, n); }

  Graph& graph_;
  const int variable_;
  const NodeId one_;
  std::map<NodeId, NodeId> known_;
};

/// Returns 1/a for each |a| whose sign the derivatives have: |a| has no derivative at a = 0, though its
/// slopes are bounded.
[[nodiscard]] std::vector<NodeId> kinks_of(Graph& graph, const std::vector<NodeId>& derivatives);

}  // namespace regulus::verifier
