// SPDX-License-Identifier: Apache-2.0
// Signs that the form of an expression shows: sums and products of squares, roots and numbers.
#pragma once

#include <map>
#include <tuple>

#include "runtime/verifier/expression.hpp"

namespace regulus::verifier {

class CertainForm {
 public:
  /// The graph must outlive this object.
  explicit CertainForm(const Graph& graph) : graph_(graph) {}

  /// Ensures   true only if sign·value ≥ 0, or > 0 if `strict`, wherever the expression is defined.
  [[nodiscard]] bool has_sign(NodeId node, int sign, bool strict);
  [[nodiscard]] bool is_nonzero(NodeId node) {
    return has_sign(node, 1, true) || has_sign(node, -1, true);
  }
  /// True if the expression has no variables.
  [[nodiscard]] bool is_constant(NodeId node);

 private:
  [[nodiscard]] bool compute(const Node& node, int sign, bool strict);
  [[nodiscard]] bool has_sign_of_product(const Node& node, int sign, bool strict);

  const Graph& graph_;
  std::map<std::tuple<NodeId, int, bool>, bool> known_;
  std::map<NodeId, bool> constant_;
};

}  // namespace regulus::verifier
