// SPDX-License-Identifier: Apache-2.0
// Computes the values of expressions over a box, in intervals of doubles or in Arb.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "runtime/verifier/ball.hpp"
#include "runtime/verifier/interval.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

using Box = std::vector<Interval>;

/// Tells which variables each node depends on.
class Dependence {
 public:
  Dependence(const Graph& graph, std::size_t variables);
  [[nodiscard]] bool on(NodeId node, std::size_t variable) const {
    return depends_[std::size_t(node) * variables_ + variable];
  }

 private:
  std::size_t variables_;
  std::vector<bool> depends_;
};

/// Returns the roots and all nodes that they are made of, operands first.
[[nodiscard]] std::vector<NodeId> ingredients(const Graph& graph, const std::vector<NodeId>& roots);
/// Returns the expression with others in the place of some of its nodes.
[[nodiscard]] NodeId replaced(Graph& graph, NodeId root, std::map<NodeId, NodeId> nodes);

/// Evaluates some roots and the nodes that they are made of. After construction it allocates memory
/// only if an operation seems to be undefined.
class Evaluation {
 public:
  /// The question must outlive this object.
  Evaluation(const Question& question, const std::vector<NodeId>& roots);

  /// Ensures   true only if every operation that the roots are made of is defined at every point of
  ///           the box that is within the ranges. Then value(n) encloses node n at these points and
  ///           is bounded.
  [[nodiscard]] bool run(const Box& box);

  /// Returns the value of a root or of a node that it is made of; 0 for kNoNode.
  [[nodiscard]] Interval value(NodeId node) const {
    return node == kNoNode ? Interval{} : values_[std::size_t(node)];
  }

  /// Encloses a root more narrowly than value() where sums cancel, and takes longer.
  ///
  /// Requires  run(box) was true.
  [[nodiscard]] Interval narrowed(NodeId root, const Box& box) const;

 private:
  struct Step {
    NodeId id;
    Node node;          ///< kConstant for each expression that does not vary
    Interval constant;  ///< of a node without operands
  };
  [[nodiscard]] Interval with_exact_operands(const Node& node, const Box& box);

  const Question& q_;
  std::vector<Step> steps_;
  std::vector<Interval> values_;  ///< by node
};

/// Returns true only if one operation is defined at every point of the values of its operands.
/// `values` has these values, by the numbers of the operands.
[[nodiscard]] bool certain_defined(const Node& node, const std::vector<Ball>& values, long bits);
/// Encloses the operation, which is not a constant or a variable, over these values.
void compute(const Node& node, const std::vector<Ball>& values, arb_ptr result, long bits);

/// Evaluates the roots in Arb, and returns their values in their order. Returns nullopt unless
/// every operation is defined at every point.
[[nodiscard]] std::optional<std::vector<Ball>> evaluate(const Graph& graph,
                                                        const std::vector<NodeId>& roots,
                                                        std::span<const Ball> variables, long bits);

}  // namespace regulus::verifier
