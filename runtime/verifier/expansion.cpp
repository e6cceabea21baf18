// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/expansion.hpp"

#include <algorithm>

namespace regulus::verifier {
namespace {

/// Most terms of one expression, and of a power. Larger ones are not multiplied out.
constexpr std::size_t kMostTermsOfAnEntry = 64;
constexpr int kMostFactors = 8;

/// The factors, in the order of their nodes; repeated factors are adjacent.
using Monomial = std::vector<NodeId>;
using Expanded = std::map<Monomial, NodeId>;

class Expander {
 public:
  Expander(Graph& graph, const std::vector<std::size_t>& variables, std::size_t count)
      : graph_(graph), varies_(graph.nodes().size()) {
    const Dependence dependence(graph, count);
    for (std::size_t i = 0; i < varies_.size(); ++i)
      for (const std::size_t k : variables) varies_[i] = varies_[i] || dependence.on(NodeId(i), k);
  }

  const Expanded& of(NodeId id) {
    if (const auto known = known_.find(id); known != known_.end()) return known->second;
    Expanded result = expand(id);
    return known_.emplace(id, std::move(result)).first->second;
  }

  NodeId product(const Monomial& factors) {
    NodeId result = kNoNode;
    for (const NodeId factor : factors)
      result = result == kNoNode ? factor : graph_.add(Op::kMultiply, result, factor);
    return result == kNoNode ? graph_.number("1") : result;
  }

 private:
  Expanded expand(NodeId id) {
    const Node node = graph_.nodes()[std::size_t(id)];
    if (!varies_[std::size_t(id)]) return {{{}, id}};
    switch (node.op) {
      case Op::kNegate:
        return scaled(of(node.a), Op::kMultiply, graph_.add(Op::kNegate, graph_.number("1")));
      case Op::kAdd:
      case Op::kSubtract:
        return sum(of(node.a), of(node.b), node.op, id);
      case Op::kMultiply:
        return product(of(node.a), of(node.b), id);
      case Op::kDivide:
        if (varies_[std::size_t(node.b)]) break;
        return scaled(of(node.a), Op::kDivide, node.b);
      case Op::kPower:
        return power(node, id);
      default:
        break;
    }
    return itself(id);
  }

  Expanded itself(NodeId id) { return {{{id}, graph_.number("1")}}; }

  Expanded scaled(Expanded p, Op op, NodeId factor) {
    for (auto& [monomial, coefficient] : p) coefficient = graph_.add(op, coefficient, factor);
    return p;
  }

  void add(Expanded& p, const Monomial& monomial, NodeId coefficient, Op op = Op::kAdd) {
    const auto [place, is_new] = p.emplace(monomial, coefficient);
    if (!is_new)
      place->second = graph_.add(op, place->second, coefficient);
    else if (op == Op::kSubtract)
      place->second = graph_.add(Op::kNegate, coefficient);
  }

  Expanded sum(Expanded left, const Expanded& right, Op op, NodeId id) {
    if (left.size() + right.size() > kMostTermsOfAnEntry) return itself(id);
    for (const auto& [monomial, coefficient] : right) add(left, monomial, coefficient, op);
    return left;
  }

  Expanded product(const Expanded& left, const Expanded& right, NodeId id) {
    if (left.size() * right.size() > kMostTermsOfAnEntry) return itself(id);
    Expanded result;
    for (const auto& [m1, c1] : left)
      for (const auto& [m2, c2] : right) {
        Monomial monomial(m1.size() + m2.size());
        std::merge(m1.begin(), m1.end(), m2.begin(), m2.end(), monomial.begin());
        add(result, monomial, graph_.add(Op::kMultiply, c1, c2));
      }
    return result;
  }

  Expanded power(const Node& node, NodeId id) {
    if (node.b > kMostFactors) return itself(id);
    Expanded result = of(node.a);
    for (int i = 1; i < node.b; ++i) {
      result = product(result, of(node.a), id);
      if (result.size() == 1 && result.begin()->first == Monomial{id}) break;
    }
    return result;
  }

  Graph& graph_;
  std::vector<bool> varies_;  ///< only asked about nodes from before the expansion
  std::map<NodeId, Expanded> known_;
};

}  // namespace

std::vector<Term> expand(Graph& graph, const std::vector<NodeId>& matrix,
                         const std::vector<std::size_t>& variables, std::size_t variable_count) {
  Expander expander(graph, variables, variable_count);
  std::map<Monomial, std::vector<Coefficient>> terms;
  for (std::size_t e = 0; e < matrix.size(); ++e)
    for (const auto& [monomial, coefficient] : expander.of(matrix[e]))
      terms[monomial].push_back({e, coefficient});
  std::vector<Term> result;
  for (auto& [monomial, coefficients] : terms)
    result.push_back({expander.product(monomial), std::move(coefficients)});
  return result;
}

}  // namespace regulus::verifier
