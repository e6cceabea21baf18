// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/single_values.hpp"

#include "runtime/verifier/algebra.hpp"
#include "runtime/verifier/evaluation.hpp"

namespace regulus::verifier {
namespace {

constexpr std::uint64_t kProductsOfEnds = 1 << 16;
constexpr long kBitsOfConstant = 256;  ///< of constants that must have a value
constexpr int kMostSimplified = 1 << 10;

/// Returns the expression of each variable that has one value only; kNoNode for the others, and for
/// the unknowns after them.
std::vector<NodeId> single_values(Question& question) {
  const std::size_t unknowns = question.closure ? question.closure->equations.size() : 0;
  std::vector<NodeId> result(question.variables.size() + unknowns, kNoNode);
  for (std::size_t k = 0; k < question.variables.size(); ++k) {
    const Variable& v = question.variables[k];
    if (are_equal(question.graph, v.hi, v.lo)) result[k] = v.lo;
  }
  return result;
}

/// Returns true if the operation has no value for some values of its operands.
bool is_partial(Op op) {
  switch (op) {
    case Op::kDivide:
    case Op::kSqrt:
    case Op::kTan:
    case Op::kAsin:
    case Op::kAcos:
    case Op::kLog:
    case Op::kAtan2:
      return true;
    default:
      return false;
  }
}

/// Rewrites expressions, each part once.
class Rewriting {
 public:
  explicit Rewriting(Question& q) : graph_(q.graph), values_(single_values(q)) {}

  void rewrite(std::vector<NodeId>& roots) {
    for (const NodeId id : ingredients(graph_, roots))
      if (!known_.contains(id)) known_.emplace(id, rewritten(id));
    for (NodeId& root : roots) root = known_.at(root);
  }

 private:
  NodeId rewritten(NodeId id) {
    const Node node = graph_.nodes()[std::size_t(id)];
    if (node.op == Op::kVariable) {
      const NodeId value = values_[std::size_t(node.a)];
      return value == kNoNode ? id : value;
    }
    if (operands(node.op) == 0) return id;
    const bool is_of_two = operands(node.op) == 2;
    NodeId a = known_.at(node.a), b = is_of_two ? known_.at(node.b) : node.b;
    if (is_partial(node.op)) {
      a = simplified(a);
      if (is_of_two) b = simplified(b);
    }
    return graph_.add(node.op, a, b);
  }

  /// Simplifies an expression without variables; others stay. An expression without a value must
  /// not get one because its undefined part is multiplied by 0.
  NodeId simplified(NodeId id) {
    if (const auto found = simplified_.find(id); found != simplified_.end()) return found->second;
    if (graph_.nodes()[std::size_t(id)].op == Op::kConstant || varies(id)) return id;
    if (simplified_.size() == kMostSimplified) return id;
    NodeId result = id;
    if (evaluate(graph_, {id}, {}, kBitsOfConstant))
      if (const auto value = exact_value(graph_, id)) result = graph_.number(*value);
    simplified_.emplace(id, result);
    return result;
  }

  /// Returns true if the expression has a variable.
  bool varies(NodeId id) {
    for (std::size_t i = varies_.size(); i < graph_.nodes().size(); ++i) {
      const Node& node = graph_.nodes()[i];
      varies_.push_back(node.op == Op::kVariable ||
                        (operands(node.op) > 0 && varies_[std::size_t(node.a)]) ||
                        (operands(node.op) > 1 && varies_[std::size_t(node.b)]));
    }
    return varies_[std::size_t(id)];
  }

  Graph& graph_;
  const std::vector<NodeId> values_;
  std::map<NodeId, NodeId> known_, simplified_;
  std::vector<bool> varies_;  ///< by node
};

}  // namespace

bool are_equal(Graph& graph, NodeId a, NodeId b) {
  if (a == b) return true;
  const std::vector<NodeId> none;
  AlgebraBudget budget(kProductsOfEnds);
  Algebra algebra(graph, none, Algebra::Form::kFull, budget);
  try {
    return algebra.vanishes(algebra.of(graph.add(Op::kSubtract, a, b)));
  } catch (const TooLarge&) {
    return false;
  }
}

void put_in_single_values(Question& q) {
  Rewriting rewriting(q);
  for (auto* roots : {&q.matrix, &q.scale, &q.defined, &q.motion_defined, &q.constraints})
    rewriting.rewrite(*roots);
  if (q.closure) rewriting.rewrite(q.closure->equations);
  if (q.quantity) {
    rewriting.rewrite(q.quantity->by_motor);
    rewriting.rewrite(q.quantity->model_matrix);
    rewriting.rewrite(q.quantity->row_scales);
    rewriting.rewrite(q.quantity->unscaled);
  }
}

}  // namespace regulus::verifier
