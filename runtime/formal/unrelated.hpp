// SPDX-License-Identifier: Apache-2.0
// Which equations of cosines and sines Coq does not see.
#pragma once

#include <map>

#include "runtime/verifier/expression.hpp"

namespace regulus::verifier {

[[nodiscard]] bool has_variables(const Graph& graph, NodeId node);
/// True for a number that is a multiple of 30 or of 45 degrees: Coq knows its cosine and its sine.
[[nodiscard]] bool is_known_angle(Graph& graph, NodeId angle);

/// Multiplies cosines and sines by other functions of their angles, so that they are not related any
/// more: cos² + sin² is not 1. Equal and opposite angles stay so, and numbers stay as they are.
class Unrelated {
 public:
  explicit Unrelated(Graph& graph) : graph_(graph) {}
  [[nodiscard]] NodeId of(NodeId node);

 private:
  NodeId even_factor(const Node& function);

  Graph& graph_;
  std::map<NodeId, NodeId> known_;
};

}  // namespace regulus::verifier
